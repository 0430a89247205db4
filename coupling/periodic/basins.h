#pragma once

#include "coupling/periodic/periodic_method.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace gestell::coupling
{

/// Initial states with two numbers of (q, q') [2n] varied over a rectangle, at the centres of points x points cells.
struct StartPlane
{
  int    x = 0, y = 1; ///< which; from n on rates
  double x_begin = 0., x_end = 0., y_begin = 0., y_end = 0.;
  int    points = 60;
  double x_sign = 1., y_sign = 1.; ///< of what the plane shows, in these numbers

  double x_at(int i) const { return x_begin + (i + 0.5) * (x_end - x_begin) / points; }
  double y_at(int j) const { return y_begin + (j + 0.5) * (y_end - y_begin) / points; }
};

/// The solution to which each initial state settles.
struct Basins
{
  static constexpr int not_reached = 0, not_looked_at = -1;

  /// Where a stable motion begins a period, seen in the plane.
  struct Place
  {
    int    motion;
    double x, y;
  };

  StartPlane         plane;
  std::vector<Place> places;
  Eigen::MatrixXi    motion;  ///< (i, j) of the start (x_at(i), y_at(j)): number of the solution, from 1
  Eigen::MatrixXi    periods; ///< after which it was there
  PeriodicWork       work;

  bool   is_complete() const { return (motion.array() != not_looked_at).all(); }
  double share(int solution) const; ///< of the starts looked at
};

/**
 * Integrates from every start until the state at the begin of a period of the excitation is nearer to a stable motion,
 * in any of its periods, than a hundredth of that motion's distance to all others, stable or not, and of its own size:
 *
 *     |S (x - x_motion)| <= 0.01 min(size, distance),     S = diag(2 pi/T, 1)
 *
 * An initial state that does not settle in options.periods, diverges or needs too many steps has not_reached; those
 * after an interruption have not_looked_at.
 *
 * @param solutions  all that are known; numbers are their places in this list
 * @param rest       of the start: what does not vary
 * @param progress   share that is done
 * @throws std::invalid_argument: none of the solutions is stable, the period is unknown (starts would differ in their
 *         phase alone), or the plane is none
 */
Basins basins_of(const PeriodicProblem &problem, const std::vector<PeriodicSolution> &solutions,
                 const PeriodicGuess &rest, const StartPlane &plane, const PeriodicOptions &options,
                 const std::function<void(double)> &progress);

} // namespace gestell::coupling
