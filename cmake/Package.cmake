# In the build folder, when all is built. `cpack -G DEB`: tessera_<version>_<architecture>.deb for the
# Debian that it was built on. `cpack -G TGZ`: a folder with all libraries, for any Linux whose glibc
# is not older (PackageOptions.cmake, PortableFiles.cmake).
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
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/PackageOptions.cmake)
set(CPACK_TESSERA_LIBDIR ${CMAKE_INSTALL_LIBDIR})
string(TOLOWER ${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR} CPACK_TESSERA_PLATFORM)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
string(
  CONCAT CPACK_DEBIAN_PACKAGE_DESCRIPTION  # Below the one line that is the project's.
         "Tessera turns a CAD model into a tetrahedral mesh, cut into many conforming\n"
         "pieces, under MPI. The same case gives the same bits for every number of ranks.\n"
         "It also checks meshes and cuts them anew for a solver.\n"
         ".\n"
         "This package has the program, its library with headers, a CMake package, and a\n"
         "Python package."
)
# What libraries are needed dpkg-shlibdeps sees; the program is started by mpirun.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
# For `import tessera` in Python, and for views in pages.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-vtk9, libjs-three")
# For who compiles against the headers; ParaView shows the results; Python hands meshes to the others.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "libopenmpi-dev, cmake, paraview, python3-mpi4py, python3-dolfinx, python3-petsc4py, python3-meshio"
)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Debian's way to tell the loader of a new library; the scripts that cpack writes are another.
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
# Python's byte code, which would else stay behind when the package is removed.
file(
  CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/postinst
  CONTENT "#!/bin/sh\nset -e\n! command -v py3compile >/dev/null || py3compile -p tessera\n"
)
file(
  CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/debian/prerm
  CONTENT "#!/bin/sh\nset -e\n! command -v py3clean >/dev/null || py3clean -p tessera\n"
)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${PROJECT_BINARY_DIR}/debian/triggers ${PROJECT_BINARY_DIR}/debian/postinst
    ${PROJECT_BINARY_DIR}/debian/prerm
)

include(CPack)
