#pragma once

#include "coupling/factors/stiffness_factor.h"

namespace gestell::coupling
{

/// @param name  of the table of StiffnessFactor; empty: "gestell" in one process, "mumps" on several ranks.
/// @throws std::invalid_argument for a factor of one process on several ranks.
std::unique_ptr<StiffnessFactor> make_factor(const std::string &name, FactorMatrices matrices);

} // namespace gestell::coupling
