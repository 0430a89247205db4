#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * The linear base system M q'' + B q' + C q of a machine (5.5.2/1), constant and symmetric, in the storage that suits
 * it.
 *
 * Results are written into vectors of the right size without allocation; x and y are different vectors.
 */
class LinearBase
{
public:
  virtual ~LinearBase();

  virtual int  size() const                                                        = 0;
  virtual void mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const      = 0;
  virtual void damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const   = 0;
  virtual void stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const = 0;

  /// Solver for A = w_M M + w_B B + w_C C (5.5.2/13); it lives on its own after the base is gone.
  /// @throws std::invalid_argument if A is singular, naming the coordinate by its index.
  virtual std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const = 0;

  /// Modes of the undamped system, omega ascending, each with the damping ratio v^T B v / (2 omega v^T M v); a mode
  /// without stiffness has omega = 0 and zeta = 0.
  virtual std::vector<SpectrumLine> spectrum() const = 0;
};

} // namespace gestell::coupling
