#pragma once

#include "apps/cli/command.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * A script that completes commands, options, their choices and input files.
 *
 * @param shell  "bash", to be sourced or stored with bash's completions as "gestell"; "zsh", as "_gestell" in its fpath
 * @throws std::invalid_argument for another shell
 */
std::string completion(const CLI::App &program, const std::vector<Command> &all, const std::string &shell);

} // namespace gestell::apps
