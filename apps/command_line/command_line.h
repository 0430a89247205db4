#pragma once

#include "apps/cli/command.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The options and commands of the program for CLI11; values are stored in `options` and in those of the commands,
/// which must live as long.
std::unique_ptr<CLI::App> command_line(const std::vector<Command> &all, CommonOptions &options);

/// @throws std::invalid_argument if the first word is neither an option nor a command, with the most similar one
void require_command(const CLI::App &program, const std::string &word);

/// Error for input that CLI11 rejects, with its command and the help to read.
std::invalid_argument refused(const CLI::App &program, const std::string &why);

/// Error for the rest of the command line: an option of another command, a typing error, a second scene.
std::invalid_argument unexpected(const CLI::App &program);

} // namespace gestell::apps
