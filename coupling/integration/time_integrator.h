#pragma once

#include "coupling/integration/second_order_system.h"

namespace gestell::coupling
{

/// An accepted instant: state, motion of the local measures and their forces.
struct Instant
{
  double          t = 0.;
  Eigen::VectorXd q, v; // [n]
  LocalState      local;
  Eigen::VectorXd p; // [n_u]
};

/// What the integration cost, independent of the machine it ran on.
struct IntegrationWork
{
  long steps = 0, rejected = 0, newton = 0, factorisations = 0, solves = 0;
};

/**
 * Carries a SecondOrderSystem through time in steps of its own choosing.
 *
 * begin() and advance() never change the history of the system's elements: whoever drives the integrator accepts the
 * instant (SecondOrderSystem::accept) and takes the transitions of events.
 */
class TimeIntegrator
{
public:
  virtual ~TimeIntegrator() = default;

  /// Starts at t with q, v [n]; the history of the elements must have been started.
  virtual void begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) = 0;

  /// One step to the next grid point.
  /// @throws ConvergenceFailure naming time, coordinate and residual; instant() is then the last accepted one.
  virtual void advance() = 0;

  virtual const Instant         &instant() const = 0;
  virtual const IntegrationWork &work() const    = 0;
};

} // namespace gestell::coupling
