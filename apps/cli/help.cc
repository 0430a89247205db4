#include "apps/cli/command_reference.h"
#include "apps/cli/commands.h"
#include "apps/reference/declared_tables.h"
#include "apps/reference/help_text.h"
#include "apps/reference/json_schema.h"
#include "apps/reference/key_tables.h"

#include <iostream>
#include <memory>

namespace gestell::apps
{
namespace
{

struct HelpCommandOptions
{
  std::string topic; ///< table or key; empty: the list of tables
  bool        schema = false;
  std::string docs; ///< folder whose schema and tables of keys are renewed; empty: none
};

std::vector<std::string> tables()
{
  std::vector<std::string> paths;
  for (const DeclaredTable &table : declared_tables())
    paths.push_back(table.path);
  return paths;
}

int help(const HelpCommandOptions &help)
{
  if (!help.docs.empty())
    renew_reference(help.docs, command_reference(commands()));
  else
    std::cout << (help.schema ? json_schema() : help_text(help.topic));
  return exit_done;
}

} // namespace

Command help_command()
{
  const auto own = std::make_shared<HelpCommandOptions>();
  return {
      "help",
      "list commands by question, explain the keys of scenes and studies",
      {"gestell help element.clearance", "gestell help stiffness", "gestell help \"what force\""},
      CommandInput::none,
      {CommandOption{"KEY", &own->topic, "table, key or words of a question (default: lists of questions and tables)"}
           .proposing(tables()),
       {"--schema", &own->schema, "only print the JSON schema of scenes, for editors"},
       {"--renew", &own->docs, "only regenerate schemas, key tables and options in this documentation folder"}},
      [own](const CommonOptions &) { return help(*own); }};
}

} // namespace gestell::apps
