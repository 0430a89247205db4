#pragma once

#include "apps/session/modes_options.h"
#include "apps/session/prepared_machine.h"

namespace gestell::apps
{

/// Modes along a coordinate, with the orders of excitation that meet them.
/// @throws std::invalid_argument for options that do not fit: which, the value, and what is needed
AlongResult modes_along_result(const Scene &scene, PreparedMachine &prepared, const ModesOptions &options,
                               const coupling::Progress &progress = {});

/// What has to be told of it: gaps, positions without equilibrium, lines that may have been taken for one another.
std::vector<std::string> along_warnings(const AlongResult &along);

/// "100 deg", "2.4 m"
std::string position_text(const coupling::SweptCoordinate &coordinate, double x);

} // namespace gestell::apps
