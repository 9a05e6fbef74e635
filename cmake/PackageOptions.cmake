# Read by cpack before it makes a package. `cpack -G TGZ` packs a folder that runs wherever it is
# unpacked, with all libraries but glibc and MPI; `-D TESSERA_MPI_INSIDE=ON` packs Open MPI, too.
if(CPACK_GENERATOR STREQUAL "TGZ")
  set(CPACK_PACKAGING_INSTALL_PREFIX /)
  set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/PortableFiles.cmake)
  set(CPACK_PACKAGE_FILE_NAME tessera-${CPACK_PACKAGE_VERSION}-${CPACK_TESSERA_PLATFORM})
  set(component mpi_outside)
  if(TESSERA_MPI_INSIDE)
    string(APPEND CPACK_PACKAGE_FILE_NAME -mpi)
    set(component mpi_inside)
  endif()
  list(GET CPACK_INSTALL_CMAKE_PROJECTS 0 build)
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS ${build} tessera ${component} /)
endif()
