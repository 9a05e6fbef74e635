# Run by ctest with BUILD, PROJECT, WORK, GENERATOR, COMPILER and SANITIZE set.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A libtessera with ASan can be linked only by a program with ASan.
set(flags "")
if(SANITIZE)
  set(flags "-fsanitize=address,undefined")
endif()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(
  ${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${flags}
)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/user_program)
