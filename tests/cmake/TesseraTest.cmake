include(GoogleTest)

# More ranks than cores, for Open MPI 4 and 5, root in a container, and no network: Open MPI 5 complains
# of one that leads nowhere, though it needs none. Without libraries of fast networks, which look for cards
# in all of the kernel's symbols, ranks start in half the time. The last one is MPICH's: a rank that waits
# sleeps in between. check_mesh.np3 takes 21 s on two cores then, and more than 280 s else.
set(TESSERA_MPI_ENVIRONMENT
    "OMPI_MCA_rmaps_base_oversubscribe=1;PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_mpi_yield_when_idle=1;OMPI_MCA_pml=ob1;OMPI_MCA_btl=^tcp,ofi,openib,usnic;MPIR_CVAR_ENABLE_HEAVY_YIELD=1"
)

# tessera_test_timeout(<variable> <seconds>): from the seconds within which a sound test ends on an idle
# machine. Beside other tests and builds some took ten times as long; sanitizers slow third-party code
# tenfold and more.
function(tessera_test_timeout variable seconds)
  set(factor 4)
  if(TESSERA_SANITIZE)
    set(factor 20)
  endif()
  math(EXPR seconds "${factor} * ${seconds}")
  set(${variable} ${seconds} PARENT_SCOPE)
endfunction()

function(tessera_compile_quickly target)
  tessera_optimize_less(${target})
  if(TARGET tessera_test_headers)
    target_precompile_headers(${target} REUSE_FROM tessera_test_headers)
  endif()
endfunction()

# tessera_add_test(<name> SOURCES <file>... TIMEOUT <seconds> [LINK <target>...] [LABEL <label>])
#
# One process, no MPI; one ctest entry. The label is "unit" unless said otherwise.
function(tessera_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT;LABEL" "SOURCES;LINK")
  foreach(required IN ITEMS SOURCES TIMEOUT)
    if(NOT DEFINED arg_${required})
      message(FATAL_ERROR "tessera_add_test(${name}): ${required} is required")
    endif()
  endforeach()
  if(NOT DEFINED arg_LABEL)
    set(arg_LABEL unit)
  endif()

  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE tessera_test_support ${arg_LINK} GTest::gtest_main)
  tessera_compile_quickly(test_${name})
  add_test(NAME ${name} COMMAND test_${name})
  tessera_test_timeout(timeout ${arg_TIMEOUT})
  set_tests_properties(${name} PROPERTIES LABELS ${arg_LABEL} TIMEOUT ${timeout})
endfunction()

# tessera_add_mpi_test(<name> SOURCES <file>... RANKS <n>... TIMEOUT <seconds> [LINK <target>...] [OWN_MAIN])
#
# One ctest entry "<name>.np<n>" per rank count, label "mpi". TIMEOUT is required: a hang is how a
# missed collective shows. PROCESSORS keeps `ctest -j` from running more ranks than cores at once.
# OWN_MAIN: the sources have a main() that starts MPI, say because processes must be forked before.
function(tessera_add_mpi_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "OWN_MAIN" "TIMEOUT" "SOURCES;RANKS;LINK")
  foreach(required IN ITEMS SOURCES RANKS TIMEOUT)
    if(NOT DEFINED arg_${required})
      message(FATAL_ERROR "tessera_add_mpi_test(${name}): ${required} is required")
    endif()
  endforeach()

  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE tessera_test_support ${arg_LINK})
  tessera_compile_quickly(test_${name})
  if(NOT arg_OWN_MAIN)
    target_link_libraries(test_${name} PRIVATE tessera_mpi_gtest_main)
  endif()
  tessera_test_timeout(timeout ${arg_TIMEOUT})
  foreach(np IN LISTS arg_RANKS)
    add_test(
      NAME ${name}.np${np}
      COMMAND
        ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${np} ${MPIEXEC_PREFLAGS}
        $<TARGET_FILE:test_${name}> ${MPIEXEC_POSTFLAGS}
    )
    set_tests_properties(
      ${name}.np${np}
      PROPERTIES
        LABELS mpi
        PROCESSORS ${np}
        TIMEOUT ${timeout}
        ENVIRONMENT "${TESSERA_MPI_ENVIRONMENT}"
    )
  endforeach()
endfunction()
