#pragma once

#include "coupling/periodic/followed_equations.h"
#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// All methods for periodic solutions.
const std::vector<const PeriodicMethod *> &periodic_methods();

/// @throws std::invalid_argument for an unknown name
const PeriodicMethod &periodic_method(const std::string &name);

/// Why a method follows no branch, and an alternative; empty: it does.
std::string why_no_branch(const PeriodicMethod &method);

/// Equations of the branch from a solution on, whose motions repeat after `ratio` times the period of the family.
std::unique_ptr<BranchEquations> branch_from(const PeriodicSolution &first, const ProblemFamily &family,
                                             const PeriodicOptions &options, int ratio);

/// Options of single methods, each once.
std::vector<PeriodicOption> options_of_periodic_methods();

} // namespace gestell::coupling
