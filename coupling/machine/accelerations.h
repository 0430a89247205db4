#pragma once

#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine_model.h"

#include <memory>
#include <optional>
#include <vector>

namespace gestell::coupling
{

/**
 * The accelerations q'' [n] that the equation of motion gives to a motion,
 *
 *     M q'' = r,     r = f_t + W p(t, u, u', history) - B q' - C q,
 *
 * with the accuracy of positions, velocities and multipliers of joints, for every method, at ends of steps and on the
 * dense output, before and after an event.  At ends of steps of BDF they are those of its formula.
 *
 * Signals read products of q'' with a few rows, the sum of many accelerations for the force of a support.  With an
 * orthonormal basis Q [n x k] of these rows and Z = M^-1 Q, the result is
 *
 *     Q Q^T q'' = Q (Z^T f_t + (W^T Z)^T p - (B Z)^T q' - (C Z)^T q),
 *
 * without a solution for every instant.  Many rows are not worth that: the result is then q'' itself.
 *
 * For virtual coordinates it is 0.
 */
class Accelerations
{
public:
  /// Factorises M.  Coordinates without mass are allowed if their accelerations are not read.
  /// @param signals  that read the accelerations
  /// @throws std::invalid_argument if a row reads them
  Accelerations(const SecondOrderSystem &system, const std::vector<Signal> &signals);

  /// @param q,     v   [n]
  /// @param local  the same motion in the measures; its p is used for joints and sticking elements, which have no law
  /// @return [n], valid until the next call
  const Eigen::VectorXd &at(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const LocalState &local);
  /// The same at t in the last step of an integrator.
  /// @param local  the motion of the measures there
  /// @param q,     v   [n] receive the motion there
  const Eigen::VectorXd &at(double t, const TimeIntegrator &integrator, const LocalState &local, Eigen::VectorXd &q,
                            Eigen::VectorXd &v);

private:
  void add_row(Eigen::VectorXd row, Eigen::Index most_rows);
  void solve_row(const Eigen::VectorXd &s, bool regular);
  void solve_rows(bool regular);

  const SecondOrderSystem      &system_;
  std::unique_ptr<LinearSolver> mass_;
  Eigen::MatrixXd               Q_, Z_, BZ_, CZ_, WZ_;
  bool                          by_rows_ = true;
  Eigen::VectorXd               p_, f_, product_, a_, c_;
};

/// Evaluator of the accelerations that signals read; none if no signal reads any.
/// @throws std::invalid_argument as Accelerations does
std::optional<Accelerations> accelerations_for(const std::vector<Signal> &signals, const SecondOrderSystem &system);

} // namespace gestell::coupling
