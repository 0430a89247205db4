#pragma once

#include "coupling/factors/stiffness_factor.h"

namespace gestell::coupling
{

/// "gestell"
std::unique_ptr<StiffnessFactor> own_stiffness_factor(FactorMatrices matrices);

} // namespace gestell::coupling
