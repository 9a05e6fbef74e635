# What a page needs to show a surface, compiled in: TESSERA_VIEWER_SOURCE. The scripts are put one behind
# the other, in this order: a class stands behind what it extends.
set(viewer ${PROJECT_SOURCE_DIR}/pipeline/viewer/web)
set(viewer_scripts "")
foreach(script IN ITEMS arrays colours edges entries orbit scene surface panel picker viewer model start)
  list(APPEND viewer_scripts ${viewer}/${script}.js)
endforeach()
set(TESSERA_VIEWER_SOURCE ${PROJECT_BINARY_DIR}/viewer/viewer_files.cpp)
add_custom_command(
  OUTPUT ${TESSERA_VIEWER_SOURCE}
  COMMAND
    ${CMAKE_COMMAND} -DOUTPUT=${TESSERA_VIEWER_SOURCE} -DSTYLE=${viewer}/viewer.css
    -DMARKUP=${viewer}/viewer.html "-DSCRIPT=${viewer_scripts}" -P
    ${PROJECT_SOURCE_DIR}/cmake/EmbedViewer.cmake
  DEPENDS ${viewer_scripts} ${viewer}/viewer.css ${viewer}/viewer.html
          ${PROJECT_SOURCE_DIR}/cmake/EmbedViewer.cmake
  COMMENT "Embedding the viewer"
  VERBATIM
)
