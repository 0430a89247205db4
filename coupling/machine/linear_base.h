#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * The linear base system M q'' + B q' + C q of a machine (5.5.2/1), constant and symmetric, in a suitable storage
 * format.
 *
 * Results are written into vectors of the right size without allocation; x and y must be different vectors.
 */
class LinearBase
{
public:
  virtual ~LinearBase();

  virtual int  size() const                                                        = 0;
  virtual void mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const      = 0;
  virtual void damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const   = 0;
  virtual void stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const = 0;

  /// Solver for A = w_M M + w_B B + w_C C (5.5.2/13); it is independent of the lifetime of the base.
  /// @throws std::invalid_argument if A is singular, with the index of the coordinate.
  virtual std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const = 0;

  /// Modes of the undamped system, omega ascending, each with the damping ratio v^T B v / (2 omega v^T M v); a mode
  /// without stiffness has omega = 0 and zeta = 0.
  virtual std::vector<SpectrumLine> spectrum() const = 0;

  /// The same with whole matrices, if this one has none.
  virtual const LinearBase &plain() const { return *this; }
};

} // namespace gestell::coupling
