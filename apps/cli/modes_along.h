#pragma once

#include "apps/cli/modes_options.h"
#include "apps/cli/prepared_machine.h"

namespace gestell::apps
{

/// What `gestell modes --along` computes.
/// @throws std::invalid_argument for options that do not fit: which, the value, and what is needed
AlongResult modes_along_result(const Scene &scene, PreparedMachine &prepared, const ModesCommandOptions &options,
                               ProgressLine &progress);

/// What has to be told of it: gaps, positions without equilibrium, lines that may have been taken for one another.
std::vector<std::string> along_warnings(const AlongResult &along);

/// Extremes of each line and the orders met, on standard output.
void print_along(const AlongResult &along);

} // namespace gestell::apps
