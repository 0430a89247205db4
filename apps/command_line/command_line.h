#pragma once

#include "apps/cli/command.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The program's options and commands as CLI11 reads them; values go to `options` and to those of the commands, which
/// must live as long.
std::unique_ptr<CLI::App> command_line(const std::vector<Command> &all, CommonOptions &options);

/// @throws std::invalid_argument if the first word is neither an option nor a command, with the nearest one
void require_command(const CLI::App &program, const std::string &word);

/// What CLI11 refuses, with its command and where to look.
std::invalid_argument refused(const CLI::App &program, const std::string &why);

/// What is left of the command line: an option of another command, a slip, a second scene.
std::invalid_argument unexpected(const CLI::App &program);

} // namespace gestell::apps
