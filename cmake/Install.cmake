# `cmake --install`: the library, its headers, the program with its man page and completion, the Python
# package, documents, examples of cases, and the package for find_package(tessera).
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
install(TARGETS tessera EXPORT tesseraTargets)
if(TARGET tessera_netgen_library)  # Loaded, never linked: without the link for developers.
  install(TARGETS tessera_netgen_library LIBRARY NAMELINK_SKIP)
endif()
install(DIRECTORY include/tessera TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp")
if(TARGET tessera_program)
  install(TARGETS tessera_program)
  install(FILES ${TESSERA_MAN_PAGE} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(
    FILES ${TESSERA_BASH_COMPLETION} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME tessera
  )
endif()

# The Python package, where Debian's python3 looks. Its version stands in metadata, as pip would write it.
set(python_folder lib/python3/dist-packages)
install(
  DIRECTORY src/python/tessera DESTINATION ${python_folder}
  FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE
)
configure_file(cmake/PythonMetadata.in ${PROJECT_BINARY_DIR}/python/METADATA @ONLY)
install(
  FILES ${PROJECT_BINARY_DIR}/python/METADATA
  DESTINATION ${python_folder}/tessera-${PROJECT_VERSION}.dist-info
)

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md")
# As they stand to each other in configs/: a case names its model by a relative path.
install(
  DIRECTORY configs/cases configs/geometry
  DESTINATION ${CMAKE_INSTALL_DATADIR}/tessera
)
install(FILES configs/README.md configs/reference.toml DESTINATION ${CMAKE_INSTALL_DATADIR}/tessera)

install(EXPORT tesseraTargets NAMESPACE tessera:: DESTINATION ${package_folder})
configure_package_config_file(
  cmake/tesseraConfig.cmake.in ${PROJECT_BINARY_DIR}/tesseraConfig.cmake
  INSTALL_DESTINATION ${package_folder}
)
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake COMPATIBILITY SameMinorVersion
)
install(
  FILES ${PROJECT_BINARY_DIR}/tesseraConfig.cmake ${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake
  DESTINATION ${package_folder}
)
if(NOT BUILD_SHARED_LIBS)
  install(
    FILES cmake/LinkedLibraries.cmake DESTINATION ${package_folder} RENAME tesseraLinkedLibraries.cmake
  )
endif()
