# Run by ctest with BUILD, EXAMPLES, WORK, GENERATOR, COMPILER and SANITIZE set: installs the package
# into a fresh prefix, then builds every example on it alone, as a user would.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A libtessera with ASan can be linked only by a program with ASan.
set(flags "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror")
if(SANITIZE)
  string(APPEND flags " -fsanitize=address,undefined")
endif()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(example IN ITEMS mesh_from_cad mass_matrix)
  run(
    ${CMAKE_COMMAND} -S ${EXAMPLES}/${example} -B ${WORK}/${example} -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${flags}
  )
  run(${CMAKE_COMMAND} --build ${WORK}/${example})
endforeach()
