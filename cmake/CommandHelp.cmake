# The man page and the completion for bash, made of the command line that the program itself parses.
set(TESSERA_MAN_PAGE ${PROJECT_BINARY_DIR}/share/tessera.1)
set(TESSERA_BASH_COMPLETION ${PROJECT_BINARY_DIR}/share/tessera.bash)

add_executable(make_command_help ${PROJECT_SOURCE_DIR}/pipeline/tools/make_command_help.cpp)
target_link_libraries(make_command_help PRIVATE tessera_pipeline tessera_warnings)
add_custom_command(
  OUTPUT ${TESSERA_MAN_PAGE} ${TESSERA_BASH_COMPLETION}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/share
  COMMAND make_command_help man ${TESSERA_MAN_PAGE}
  COMMAND make_command_help bash ${TESSERA_BASH_COMPLETION}
  DEPENDS make_command_help
  COMMENT "Making man page and completion"
  VERBATIM
)
add_custom_target(command_help ALL DEPENDS ${TESSERA_MAN_PAGE} ${TESSERA_BASH_COMPLETION})
# Who builds only the program can install it.
add_dependencies(tessera_program command_help)
