# Imported targets for the libraries that libtessera itself is linked with. Read by this project and,
# if libtessera is static, by find_package(tessera): then who links it needs all of them.
#
# Set before: TESSERA_WITH_NETGEN, TESSERA_WITH_PTSCOTCH, TESSERA_WITH_VTK.
include(CMakeFindDependencyMacro)

# In a user's find_package(tessera) a missing package must not end CMake, but leave tessera not found.
macro(tessera_find_package)
  if(CMAKE_FIND_PACKAGE_NAME STREQUAL "tessera")
    find_dependency(${ARGV})
  else()
    find_package(${ARGV} REQUIRED)
  endif()
endmacro()

# Headers and libraries without a CMake package in Debian.
function(tessera_import_library target header library)
  if(TARGET ${target})
    return()
  endif()
  find_path(${target}_INCLUDE_DIR ${header} ${ARGN} REQUIRED)
  find_library(${target}_LIBRARY ${library} ${ARGN} REQUIRED)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${${target}_INCLUDE_DIR})
  target_link_libraries(${target} INTERFACE ${${target}_LIBRARY})
endfunction()

# NETGEN with OpenCASCADE. Debian's NetgenConfig.cmake insists on the GUI program being installed and
# lists the definitions of GUI and Python; only the four below change what the headers declare.
function(tessera_import_netgen)
  if(TARGET netgen::netgen)
    return()
  endif()
  find_path(NETGEN_INCLUDE_DIR netgen/meshing/meshing.hpp REQUIRED)
  # 6.2.1905 has a library for each of its parts, later versions have one for all.
  find_library(NETGEN_mesh_LIBRARY mesh PATH_SUFFIXES netgen)
  if(NETGEN_mesh_LIBRARY)
    set(libraries csg stl occ mesh interface ngcore)
    get_filename_component(folder ${NETGEN_mesh_LIBRARY} DIRECTORY)
    set(where PATHS ${folder} NO_DEFAULT_PATH)
  else()
    set(libraries nglib ngcore)
    set(where "")
  endif()
  add_library(netgen::netgen INTERFACE IMPORTED)
  target_include_directories(
    netgen::netgen SYSTEM INTERFACE ${NETGEN_INCLUDE_DIR}/netgen ${NETGEN_INCLUDE_DIR}/netgen/include ${OpenCASCADE_INCLUDE_DIR}
  )
  target_compile_definitions(
    netgen::netgen INTERFACE PARALLEL OCCGEOMETRY _OCC64 HAVE_DLFCN_H
  )
  foreach(library IN LISTS libraries)
    find_library(NETGEN_${library}_LIBRARY ${library} ${where} REQUIRED)
    target_link_libraries(netgen::netgen INTERFACE ${NETGEN_${library}_LIBRARY})
  endforeach()
  # OpenCASCADE 7.8 has renamed the toolkits that read files.
  if(TARGET TKDESTEP)
    set(readers TKDESTEP TKDEIGES TKDESTL)
  else()
    set(readers TKSTEP TKIGES TKSTL TKXDESTEP TKXDEIGES)
  endif()
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
              TKLCAF
              TKXCAF
              TKCAF
              TKCDF
              ${readers}
  )
endfunction()

tessera_find_package(MPI COMPONENTS CXX)
tessera_find_package(fmt)
tessera_find_package(spdlog)
tessera_find_package(ZLIB)
tessera_import_library(xxhash::xxhash xxhash.h xxhash)
tessera_import_library(metis::metis metis.h metis)
# HDF5 without MPI: ranks write their parts of its files by themselves.
tessera_import_library(hdf5::hdf5 hdf5.h hdf5_serial PATH_SUFFIXES hdf5/serial)
if(TESSERA_WITH_PTSCOTCH)
  # With 64-bit numbers, as meshes have more than 2^31 faces.
  tessera_import_library(ptscotch::ptscotch ptscotch.h ptscotch PATH_SUFFIXES scotch-int64)
  target_link_libraries(ptscotch::ptscotch INTERFACE MPI::MPI_CXX)
endif()
if(TESSERA_WITH_VTK)
  tessera_find_package(VTK COMPONENTS CommonCore CommonDataModel CommonExecutionModel CommonMisc IOCore IOXML)
endif()
if(TESSERA_WITH_NETGEN)
  tessera_find_package(OpenCASCADE)
  tessera_import_netgen()
endif()
