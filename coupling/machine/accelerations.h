#pragma once

#include "coupling/integration/system/time_integrator.h"

#include <memory>

namespace gestell::coupling
{

/**
 * The accelerations q'' [n] that the equation of motion gives to a motion,
 *
 *     M q'' = f_t + W p(t, u, u', history) - B q' - C q,
 *
 * with the accuracy of positions, velocities and multipliers of joints, for every method, at ends of steps and on the
 * dense output, before and after an event.  At ends of steps of BDF they are those of its formula.
 *
 * For virtual coordinates they are 0.
 */
class Accelerations
{
public:
  /// Factorises M.
  /// @throws std::invalid_argument if M is singular, with a coordinate without mass
  explicit Accelerations(const SecondOrderSystem &system);

  /// @param q,     v   [n]
  /// @param local  the same motion in the measures; its p is used for joints and sticking elements, which have no law
  const Eigen::VectorXd &at(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const LocalState &local);
  /// The same at t in the last step of an integrator.
  /// @param local  the motion of the measures there
  /// @param q,     v   [n] receive the motion there
  const Eigen::VectorXd &at(double t, const TimeIntegrator &integrator, const LocalState &local, Eigen::VectorXd &q,
                            Eigen::VectorXd &v);

private:
  const SecondOrderSystem      &system_;
  std::unique_ptr<LinearSolver> mass_;
  Eigen::VectorXd               p_, f_, product_, a_;
};

} // namespace gestell::coupling
