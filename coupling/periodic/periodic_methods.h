#pragma once

#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// All methods for periodic solutions.
const std::vector<const PeriodicMethod *> &periodic_methods();

/// @throws std::invalid_argument for an unknown name
const PeriodicMethod &periodic_method(const std::string &name);

/// Options of single methods, each once.
std::vector<PeriodicOption> options_of_periodic_methods();

} // namespace gestell::coupling
