#pragma once

#include "coupling/periodic/followed_equations.h"

namespace gestell::coupling
{

/// Collocation over `ratio` times the period of the family: forces at the Gauss points, free states and an unknown
/// period, on a mesh that is adapted after each point of the branch.  Multipliers come from one passage.
std::unique_ptr<BranchEquations> collocation_branch(const ProblemFamily &family, const PeriodicOptions &options,
                                                    int ratio = 1);

} // namespace gestell::coupling
