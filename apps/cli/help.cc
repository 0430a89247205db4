#include "apps/cli/commands.h"
#include "apps/reference/help_text.h"
#include "apps/reference/json_schema.h"
#include "apps/reference/key_tables.h"

#include <iostream>

namespace gestell::apps
{

int help_command(const HelpCommandOptions &help)
{
  if (!help.docs.empty())
    renew_reference(help.docs);
  else
    std::cout << (help.schema ? json_schema() : help_text(help.topic));
  return exit_done;
}

} // namespace gestell::apps
