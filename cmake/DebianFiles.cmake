# Run by cpack on the files that it is about to pack: pages that Debian wants compressed, and the
# changelog under Debian's name.
foreach(tree IN ITEMS ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
  set(share ${tree}${CPACK_PACKAGING_INSTALL_PREFIX}/share)
  file(RENAME ${share}/doc/tessera/CHANGELOG.md ${share}/doc/tessera/changelog)
  foreach(page IN ITEMS ${share}/man/man1/tessera.1 ${share}/doc/tessera/changelog)
    execute_process(COMMAND gzip -9n ${page} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
