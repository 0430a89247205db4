#pragma once

#include "coupling/integration/events/event_detection.h"
#include "coupling/periodic/periodic_problem.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * A motion as a Fourier series in the time t itself:
 *
 *     q(t) = ramp (t - t_0) + sum_h cosine_h cos(h omega t) + sine_h sin(h omega t),     h = 0 ... H.
 */
struct FourierSeries
{
  double          omega = 0.;   ///< 2 pi / T [rad/s]
  double          begin = 0.;   ///< t_0 [s]
  Eigen::VectorXd ramp;         ///< turn/T [n]
  Eigen::MatrixXd cosine, sine; ///< [n x (H + 1)]; sine.col(0) is zero

  int harmonics() const { return static_cast<int>(cosine.cols()) - 1; }
  /// q, q', q'' at t, [n] each.
  void at(double t, Eigen::VectorXd &q, Eigen::VectorXd &v, Eigen::VectorXd &a) const;
};

/// What it cost.
struct PeriodicWork
{
  long            iterations = 0;
  long            periods    = 0; ///< integrated
  IntegrationWork integration{};

  void add(const PeriodicWork &other);
};

/// A periodic solution (5.5.4/1). A state of it.
struct OrbitState
{
  double          t; ///< [s]
  Eigen::VectorXd q, v;
};

/// Verification of a solution by a run from its initial values, see verify_by_run().
struct RunVerification
{
  int         periods     = 0;     ///< that were run; 0: none
  double      departure   = 0.;    ///< largest distance at their ends, of the fastest speed
  bool        leaves      = false; ///< it leaves the solution
  bool        starts_anew = false; ///< elements have hysteresis, which was reset in every period
  std::string failure{};           ///< not empty: why it ended early
};

struct PeriodicSolution
{
  double                       begin = 0., period = 0.; ///< t_0, T [s]
  int                          ratio = 1;
  Eigen::VectorXd              q, v, turn;                                          ///< at t_0 [n]
  double                       residual = std::numeric_limits<double>::quiet_NaN(); ///< see closing_error()
  Eigen::VectorXcd             multipliers;                ///< of Floquet, largest first; empty: not known
  bool                         trivial_multiplier = false; ///< one of them is 1, of the shift in time
  std::optional<FourierSeries> series;                     ///< where the method has one: it is the motion then
  std::vector<Event>           events;                     ///< of one period
  std::vector<OrbitState>      states; ///< ascending from t_0, between which it is integrated; empty: in a single pass
  double                       share = std::numeric_limits<double>::quiet_NaN(); ///< of the starts that led there
  RunVerification              verification;                                     ///< by a run
  std::string                  method;                                           ///< that found it
  MethodOptions                integration{};                                    ///< that traces it
  std::vector<std::string>     notes;                                            ///< notes for the user
  PeriodicWork                 work;

  bool   stability_is_known() const { return multipliers.size() > 0; }
  double largest_multiplier() const; ///< in size, the trivial one left out
  bool   stable() const { return largest_multiplier() < 1. && !verification.leaves; }
};

/**
 * Periodicity residual relative to the speed of the motion: sqrt(F / max_t sum_k q'_k^2), with (5.5.4/2)
 *
 *     F = sum_k { [q_k(T) - q_k(0) - turn_k]^2 Omega^2 + [q'_k(T) - q'_k(0)]^2 },     Omega = 2 pi/T.
 */
double closing_error(const Eigen::VectorXd &dq, const Eigen::VectorXd &dv, double omega, double fastest);

/// In the order in which multipliers are listed.
Eigen::VectorXcd largest_first(Eigen::VectorXcd multipliers);

/// An instant of a motion; the history of the elements is that of the instant.
struct OrbitPoint
{
  double                 t;
  const Eigen::VectorXd &q, &v; ///< [n]
  const LocalState      &local; ///< the same in the measures, with the forces
};

} // namespace gestell::coupling
