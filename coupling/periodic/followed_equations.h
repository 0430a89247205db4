#pragma once

#include "coupling/periodic/branch_equations.h"

#include <functional>
#include <memory>

namespace gestell::coupling
{

/// A problem at one value of a parameter, with the data it refers to.
struct FamilyMember
{
  PeriodicProblem       problem;
  std::shared_ptr<void> owner; ///< of the system
};

/// The problem at each value of a parameter.  @throws std::invalid_argument where there is none
using ProblemFamily = std::function<FamilyMember(double)>;

/// Of `ratio` times its period.
/// @throws ConvergenceFailure where there is none at lambda, as at a frequency below zero to which a step has led
FamilyMember member_at(const ProblemFamily &family, double lambda, int ratio = 1);

/// Shooting over `ratio` times the period of the family.
/// @param omega  [rad/s] of the motions, by which rates are compared with coordinates
std::unique_ptr<BranchEquations> shooting_branch(const ProblemFamily &family, const PeriodicOptions &options,
                                                 double omega, int ratio = 1);
/// Harmonic balance, with as many harmonics as its first solution where their number is not given.
std::unique_ptr<BranchEquations> balance_branch(const ProblemFamily &family, const PeriodicOptions &options);

} // namespace gestell::coupling
