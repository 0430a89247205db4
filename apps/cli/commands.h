#pragma once

#include "apps/cli/command.h"

namespace gestell::apps
{

/// All commands of the program; to add one, write x.cc and its line in commands.cc.  Wrong input throws
/// std::invalid_argument; a method that fails throws ConvergenceFailure.
std::vector<Command> commands();

} // namespace gestell::apps
