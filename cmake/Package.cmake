# `cpack -G DEB` in the build folder, when all is built: tessera_<version>_<architecture>.deb for the
# Debian that it was built on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tessera)
set(CPACK_PACKAGE_VENDOR "The Tessera authors")
set(CPACK_PACKAGE_CONTACT "The Tessera authors")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_RESOURCE_FILE_README ${PROJECT_SOURCE_DIR}/README.md)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/DebianFiles.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
string(
  CONCAT CPACK_DEBIAN_PACKAGE_DESCRIPTION  # Below the one line that is the project's.
         "Tessera turns a CAD model into a tetrahedral mesh, cut into many conforming\n"
         "pieces, under MPI. The same case gives the same bits for every number of ranks.\n"
         "It also checks meshes and cuts them anew for a solver.\n"
         ".\n"
         "This package has the program, its library with headers, and a CMake package."
)
# What libraries are needed dpkg-shlibdeps sees; the program is started by mpirun.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
# For who compiles against the headers; ParaView shows the results.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libopenmpi-dev, cmake, paraview")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Debian's way to tell the loader of a new library; the scripts that cpack writes are another.
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers)

include(CPack)
