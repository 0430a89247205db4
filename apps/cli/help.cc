#include "apps/cli/commands.h"
#include "apps/reference/help_text.h"
#include "apps/reference/json_schema.h"
#include "apps/reference/key_tables.h"

#include <iostream>

namespace gestell::apps
{

int help_command(const HelpCommandOptions &help)
{
  std::cout << (help.schema ? json_schema() : help.tables ? key_tables() : help_text(help.topic));
  return exit_done;
}

} // namespace gestell::apps
