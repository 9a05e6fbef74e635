# Included by PortableFiles.cmake: share/doc/tessera/licenses has a list of the Debian packages of what is
# packed, with their versions and sources, and the licences of each.
set(licenses ${tree}/share/doc/tessera/licenses)
get_property(packed GLOBAL PROPERTY packed)

# To Debian 12 some libraries are in /lib, which is a link to /usr/lib.
set(others ${packed})
list(TRANSFORM others REPLACE "^/usr/lib/" "/lib/")
execute_process(
  COMMAND dpkg-query --search ${packed} ${others} OUTPUT_VARIABLE owners ERROR_QUIET
)
foreach(file IN LISTS packed)
  string(REPLACE "+" "\\+" pattern ${file})
  string(REGEX REPLACE "^/usr" "(/usr)?" pattern ${pattern})
  if(NOT owners MATCHES "([^\n:]+):[^\n]* ${pattern}\n")
    message(FATAL_ERROR "${file} is of no Debian package, so its licence is not known")
  endif()
  list(APPEND packages ${CMAKE_MATCH_1})
endforeach()
list(SORT packages)
list(REMOVE_DUPLICATES packages)

execute_process(
  COMMAND
    dpkg-query --show --showformat
    "\${Package} \${Version}, source \${source:Package} \${source:Version}\n" ${packages}
  OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY
)
file(
  WRITE ${licenses}/list.txt
  "Packages of Debian that parts of this folder come from. `apt source PACKAGE=VERSION` has their sources.\n\n${list}"
)
foreach(package IN LISTS packages)
  file(REAL_PATH /usr/share/doc/${package}/copyright copyright)
  file(MAKE_DIRECTORY ${licenses})
  file(COPY_FILE ${copyright} ${licenses}/${package}.txt)
endforeach()
# These texts are named by many of them.
file(GLOB common /usr/share/common-licenses/*)
foreach(license IN LISTS common)
  get_filename_component(name ${license} NAME)
  file(REAL_PATH ${license} license)
  file(MAKE_DIRECTORY ${licenses}/common-licenses)
  file(COPY_FILE ${license} ${licenses}/common-licenses/${name})
endforeach()
