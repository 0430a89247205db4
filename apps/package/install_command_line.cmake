# Writes the man page and the completions of bash and zsh, as the program `gestell` prints them.
set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")
foreach(page "man/man1/gestell.1|--man" "bash-completion/completions/gestell|--completion|bash"
    "zsh/vendor-completions/_gestell|--completion|zsh")
  string(REPLACE "|" ";" page "${page}")
  list(POP_FRONT page file)
  get_filename_component(folder "${share}/${file}" DIRECTORY)
  file(MAKE_DIRECTORY "${folder}")
  message(STATUS "Installing: ${share}/${file}")
  execute_process(COMMAND "${gestell}" ${page} OUTPUT_FILE "${share}/${file}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
