# Writes SOURCE_FILE, which tells the commit of the folder TOP; only if it changed, so that nothing is built anew otherwise.
find_package(Git QUIET)
set(commit "")
if(Git_FOUND AND EXISTS "${TOP}/.git")
  execute_process(COMMAND "${GIT_EXECUTABLE}" --no-optional-locks describe --always --dirty --abbrev=12 --exclude=*
    WORKING_DIRECTORY "${TOP}" OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT "${SOURCE_FILE}" @ONLY CONTENT [[
#include "apps/session/commit.h"

std::string gestell::apps::commit()
{
  return "@commit@";
}
]])
