# Imported targets for everything that is not ours. Each is linked PRIVATE to the one module that may
# include it (tests/lint/check_layers.py), so nothing but MPI reaches a user's compile line. All modules
# have fmt for their messages, in no public header.

find_package(MPI REQUIRED COMPONENTS CXX)
find_package(toml11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML IOParallelXML)

# Headers and libraries without a CMake package in Debian.
function(tessera_import_library target header library)
  find_path(${target}_INCLUDE_DIR ${header} REQUIRED)
  find_library(${target}_LIBRARY ${library} REQUIRED)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${${target}_INCLUDE_DIR})
  target_link_libraries(${target} INTERFACE ${${target}_LIBRARY})
endfunction()
tessera_import_library(xxhash::xxhash xxhash.h xxhash)
tessera_import_library(metis::metis metis.h metis)

# PT-Scotch with 64-bit numbers, as meshes have more than 2^31 faces.
find_path(ptscotch_INCLUDE_DIR ptscotch.h PATH_SUFFIXES scotch-int64 REQUIRED)
find_library(ptscotch_LIBRARY ptscotch PATH_SUFFIXES scotch-int64 REQUIRED)
add_library(ptscotch::ptscotch INTERFACE IMPORTED)
target_include_directories(ptscotch::ptscotch SYSTEM INTERFACE ${ptscotch_INCLUDE_DIR})
target_link_libraries(ptscotch::ptscotch INTERFACE ${ptscotch_LIBRARY} MPI::MPI_CXX)

# NETGEN with OpenCASCADE. Debian's NetgenConfig.cmake insists on the GUI program being installed and
# lists the definitions of GUI and Python; only the four below change what the headers declare.
find_path(NETGEN_INCLUDE_DIR netgen/meshing/meshing.hpp REQUIRED)
find_library(NETGEN_mesh_LIBRARY mesh PATH_SUFFIXES netgen REQUIRED)
get_filename_component(NETGEN_LIBRARY_DIR ${NETGEN_mesh_LIBRARY} DIRECTORY)
find_package(OpenCASCADE REQUIRED)
find_package(ZLIB REQUIRED)
add_library(netgen::netgen INTERFACE IMPORTED)
target_include_directories(
  netgen::netgen SYSTEM INTERFACE ${NETGEN_INCLUDE_DIR}/netgen ${NETGEN_INCLUDE_DIR}/netgen/include ${OpenCASCADE_INCLUDE_DIR}
)
target_compile_definitions(
  netgen::netgen INTERFACE PARALLEL OCCGEOMETRY _OCC64 HAVE_DLFCN_H
)
foreach(library IN ITEMS csg stl occ mesh interface ngcore)
  find_library(NETGEN_${library}_LIBRARY ${library} PATHS ${NETGEN_LIBRARY_DIR} NO_DEFAULT_PATH REQUIRED)
  target_link_libraries(netgen::netgen INTERFACE ${NETGEN_${library}_LIBRARY})
endforeach()
target_link_libraries(
  netgen::netgen
  INTERFACE MPI::MPI_CXX
            ZLIB::ZLIB
            TKernel
            TKMath
            TKBRep
            TKG2d
            TKG3d
            TKGeomBase
            TKGeomAlgo
            TKTopAlgo
            TKPrim
            TKBO
            TKBool
            TKMesh
            TKShHealing
            TKXSBase
            TKSTEP
            TKIGES
            TKSTL
            TKLCAF
            TKXCAF
            TKCAF
            TKCDF
            TKXDESTEP
            TKXDEIGES
)
