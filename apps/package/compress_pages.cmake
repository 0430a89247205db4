# Man page and changelog as Debian wants them, compressed without name and time; plain where there is no gzip.
set(prefix "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
configure_file("${top}/CHANGELOG.md" "${prefix}/${pages}/changelog" COPYONLY)
find_program(gzip gzip)
if(gzip)
  execute_process(COMMAND "${gzip}" -9nf "${prefix}/share/man/man1/gestell.1" "${prefix}/${pages}/changelog"
    COMMAND_ERROR_IS_FATAL ANY)
endif()
