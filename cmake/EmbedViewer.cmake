# cmake -DOUTPUT=FILE.cpp -DSTYLE=FILE -DMARKUP=FILE -DSCRIPT="FILE;FILE…" -P EmbedViewer.cmake: the files
# of the viewer as a source of C++, so that the program needs none of them beside it.
function(read_all result)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" content)
    string(APPEND text "${content}")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

read_all(style ${STYLE})
read_all(markup ${MARKUP})
read_all(script ${SCRIPT})
file(
  WRITE "${OUTPUT}"
  "#include \"pipeline/viewer/viewer_files.hpp\"\n\nnamespace tessera::pipeline {\n\n"
  "ViewerFiles viewer_files()\n{\n  return {R\"embedded(${style})embedded\",\n"
  "R\"embedded(${markup})embedded\",\nR\"embedded(${script})embedded\"};\n}\n\n}  // namespace tessera::pipeline\n"
)
