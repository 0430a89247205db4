#pragma once

#include "coupling/factors/stiffness_factor.h"

namespace gestell::coupling
{

/// "cholmod": its supernodal L L^T, for solutions.  CHOLMOD has no supernodal factor of an indefinite matrix: numbers
/// of modes are those of MUMPS.
std::unique_ptr<StiffnessFactor> cholmod_stiffness_factor(FactorMatrices matrices);

} // namespace gestell::coupling
