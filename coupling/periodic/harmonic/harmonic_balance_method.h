#pragma once

#include "coupling/periodic/harmonic/harmonic_balance.h"
#include "coupling/periodic/newton.h"
#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// Number of harmonics that is given; 0: none, it is chosen from the residual.
int             harmonics_of(const PeriodicOptions &options);
PeriodicOptions with_harmonics(PeriodicOptions options, int harmonics);

/// Newton's method from z, which becomes the last point; the residual is the largest |r_i| against the amplitude of its
/// measure.
NewtonResult solve_balance(HarmonicBalance &balance, const PeriodicOptions &options, Eigen::VectorXd &z);

/// The PeriodicSolution at z with its multipliers.
PeriodicSolution finished_balance(const PeriodicProblem &problem, HarmonicBalance &balance, const Eigen::VectorXd &z,
                                  double residual, const PeriodicOptions &options);

/// The next number of harmonics to try above `harmonics`; 0: there are as many as there may be.
int more_harmonics(const PeriodicProblem &problem, int harmonics);
/// Number of harmonics and their truncation error.
/// @param tolerance of the motion, above which the note gives a remedy
std::string note_of_harmonics(const HarmonicBalance &balance, const HarmonicBalance::LeftOut &left, double tolerance,
                              bool given);

/// "harmonic-balance": one solution, from one harmonic through the guess, from the motion that is integrated from
/// there, or from the linear response, as the first of them leads to one.  The number of harmonics grows until the
/// truncation error is below the tolerance; a note gives the remaining error.  Multipliers are those of Hill's matrix
/// where floquet_way() chooses it, else of a period that is integrated.
const PeriodicMethod &harmonic_balance_method();

} // namespace gestell::coupling
