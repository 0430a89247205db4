#pragma once

#include "coupling/periodic/periodic_method.h"

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

constexpr int least_section = 64; ///< periods: four for each batch

/// Long-term behaviour of a motion.
struct Recurrence
{
  /// "periodic": repeats after one period of the excitation; "sub-harmonic": after several; "settling": converging to
  /// it; "drifting": along an unconstrained coordinate; "quasi-periodic": never repeats, neighbouring trajectories stay
  /// close; "chaotic": they diverge.
  std::string     kind;
  int             repeats  = 0;  ///< periods after which it does, or soon will; 0: none up to 16
  double          exponent = 0.; ///< largest Lyapunov exponent [1/s], that of the shift in time left out
  double          error    = 0.; ///< its standard error [1/s]
  int             periods  = 0;  ///< examined, after the same number of lead-in periods
  Eigen::MatrixXd section{};     ///< q, q' at the begins of these periods, whole turns taken off [2n x periods]
  PeriodicWork    work{};

  bool is_recognised() const { return kind != "settling"; }
};

/**
 * Integrates a motion for many periods of the excitation, T, and classifies it by its Poincare section and its largest
 * Lyapunov exponent, the mean divergence rate of neighbouring trajectories (Benettin et al. 1980, Meccanica 15, 9-30):
 *
 *     exponent = 1/(K T) sum_k ln |S Phi_k d_k|,     d_(k+1) = Phi_k d_k / |S Phi_k d_k|,     S = diag(2 pi/T, 1),
 *
 * Phi_k the monodromy matrix of period k.  Where T is unknown, the section is that of the coordinate `phase`, and
 * Phi_k the derivative of its return.  Its error is that of the mean of 16 batches of periods (neighbouring terms are
 * correlated, batches hardly), or half of what both halves differ by: where neighbours part as a power of time, as in a
 * free fall, the mean falls as ln K / K and is not its limit.  With four errors as doubt (15 degrees of freedom: one in
 * a thousand),
 *
 *     exponent above zero                       chaotic
 *     section repeats to 1e-4 of the speed      periodic, sub-harmonic
 *     exponent below zero, or the motion comes ever nearer to itself some periods before     settling
 *     its first half takes less than two thirds of the room of all, and the last lies elsewhere     drifting
 *     else                                      quasi-periodic
 *
 * @param problem  a `ratio` above 1 is not looked at: the section is taken by the period of the excitation
 * @param periods  that are looked at, at least least_section; as many are gone through before
 * @throws std::invalid_argument where the integrator carries no tangents; ConvergenceFailure where the motion cannot be
 *         followed, as one that runs away; SearchInterrupted
 */
Recurrence recurrence_of(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicOptions &options,
                         int periods);

} // namespace gestell::coupling
