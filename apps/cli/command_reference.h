#pragma once

#include "apps/cli/command.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Options of all commands in Markdown, for docs/reference/commands.md.
std::string command_reference(const std::vector<Command> &all);

} // namespace gestell::apps
