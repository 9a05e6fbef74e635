# Target `docs`: the reference of the library in docs/html of the build folder. It is there if
# doxygen is; the test lint.doxygen reads the same file.
configure_file(${PROJECT_SOURCE_DIR}/cmake/Doxyfile.in ${PROJECT_BINARY_DIR}/docs/Doxyfile @ONLY)
find_program(TESSERA_DOXYGEN doxygen)
if(TESSERA_DOXYGEN)
  add_custom_target(
    docs
    COMMAND ${TESSERA_DOXYGEN} ${PROJECT_BINARY_DIR}/docs/Doxyfile
    COMMENT "Reference of the library: docs/html/index.html"
    VERBATIM
  )
endif()
