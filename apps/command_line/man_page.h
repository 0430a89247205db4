#pragma once

#include "apps/cli/command.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gestell::apps
{

/// gestell(1) for man: commands with their options and examples, exit codes, environment, files.
std::string man_page(const CLI::App &program, const std::vector<Command> &all);

} // namespace gestell::apps
