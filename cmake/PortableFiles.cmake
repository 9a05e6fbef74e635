# Run by `cpack -G TGZ` on the files that it is about to pack: adds the libraries that they need, with
# their licences, and lets each file find them from where it stands.
#
# glibc is the host's: the loader and the C library belong together. With TESSERA_MPI_INSIDE all else is
# inside, also Open MPI for one machine. Without it MPI is the host's, and so is the C++ runtime: that
# MPI may need a later one than ours.
set(tree ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
set(libraries ${tree}/${CPACK_TESSERA_LIBDIR})
set(mpi ${tree}/libexec/tessera-mpi)
find_program(PATCHELF patchelf REQUIRED)

set(of_host "^(ld-linux.*|lib(anl|c|dl|m|mvec|pthread|resolv|rt|util))\\.so")
if(NOT TESSERA_MPI_INSIDE)
  list(APPEND of_host "^lib(mpi|mpi_cxx|open-pal|open-rte|gcc_s|stdc\\+\\+)\\.so")
endif()

# Copies a file, not the link to it, into a folder.
function(pack file folder)
  get_filename_component(name ${file} NAME)
  file(REAL_PATH ${file} real)
  file(MAKE_DIRECTORY ${folder})
  file(COPY_FILE ${real} ${folder}/${name})
  set_property(GLOBAL APPEND PROPERTY packed ${real})
endfunction()

function(ask_mpi result kind)
  execute_process(
    COMMAND ompi_info --parsable --path ${kind} OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY
  )
  string(REPLACE "path:${kind}:" "" path ${said})
  set(${result} ${path} PARENT_SCOPE)
endfunction()

# mpirun, and what it and the ranks load by themselves, but for networks, other machines, batch systems
# and OpenSHMEM. pipeline/runtime/installed.cpp tells them where it is.
function(pack_mpi result)
  foreach(kind IN ITEMS bindir pkglibdir pkgdatadir sysconfdir)
    ask_mpi(${kind} ${kind})
  endforeach()
  if(NOT pkglibdir MATCHES "/openmpi3$")
    message(FATAL_ERROR "TESSERA_MPI_INSIDE is for Open MPI 4, whose plugins are not in ${pkglibdir}")
  endif()
  file(GLOB plugins ${pkglibdir}/mca_*.so)
  list(FILTER plugins EXCLUDE REGEX "_(flux|gridengine|jsm|ofi|openib|psm2?|rsh|slurm|ucx)\\.so$")
  list(FILTER plugins EXCLUDE REGEX "/mca_(atomic|memheap|scoll|spml|sshmem)_")
  foreach(plugin IN LISTS plugins)
    pack(${plugin} ${mpi}/lib/openmpi3)
  endforeach()
  pack(${bindir}/orterun ${mpi})
  pack(${sysconfdir}/openmpi-mca-params.conf ${mpi}/etc)
  file(COPY ${pkgdatadir} DESTINATION ${mpi}/share FILES_MATCHING PATTERN "help-*.txt")
  set(${result} ${plugins} PARENT_SCOPE)
endfunction()

# In front of all others, whatever LD_LIBRARY_PATH says: DT_RPATH.
function(look_for_libraries_in_tree)
  foreach(file IN LISTS ARGN)
    if(IS_SYMLINK ${file})
      continue()
    endif()
    get_filename_component(folder ${file} DIRECTORY)
    file(RELATIVE_PATH way ${folder} ${libraries})
    execute_process(
      COMMAND ${PATCHELF} --force-rpath --set-rpath $ORIGIN/${way} ${file} COMMAND_ERROR_IS_FATAL ANY
    )
  endforeach()
endfunction()

# What is compiled into the program, and no file of its own, is of these packages.
set(packages libcli11-dev libtoml11-dev libxxhash-dev nlohmann-json3-dev)
set(plugins "")
if(TESSERA_MPI_INSIDE)
  pack_mpi(plugins)
endif()
set(three_js /usr/share/javascript/three/three.min.js)
if(EXISTS ${three_js})
  pack(${three_js} ${tree}/share/tessera)
endif()

# CMake runs `ldconfig -v` for each library, which takes most of the time here: so it gets the first answer.
set(answer ${CPACK_TEMPORARY_DIRECTORY}.ldconfig)
execute_process(COMMAND ldconfig -v -N -X OUTPUT_FILE ${answer} ERROR_QUIET)
set(CMAKE_LDCONFIG_COMMAND sh -c "cat \"$0\"" ${answer})
set(CMAKE_GET_RUNTIME_DEPENDENCIES_PLATFORM linux+elf)
file(GLOB programs ${tree}/bin/* ${mpi}/orterun)
file(GLOB_RECURSE own ${libraries}/libtessera*.so*)
file(
  GET_RUNTIME_DEPENDENCIES
  EXECUTABLES ${programs}
  LIBRARIES ${own} ${plugins}
  RESOLVED_DEPENDENCIES_VAR needed
  PRE_EXCLUDE_REGEXES ${of_host} "^libtessera"
)
foreach(library IN LISTS needed)
  pack(${library} ${libraries})
endforeach()
file(GLOB_RECURSE files ${libraries}/*.so* ${mpi}/*.so)
look_for_libraries_in_tree(${programs} ${files})

include(${CMAKE_CURRENT_LIST_DIR}/PackedLicenses.cmake)
