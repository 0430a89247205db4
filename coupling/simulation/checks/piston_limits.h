#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Checks cylinders of oil and of gas after every step: pressures of oil below zero, at which it cavitates, and pistons
/// at the end of their stroke.  Their laws know neither.
class PistonLimits : public RunObserver
{
public:
  PistonLimits(const Machine &machine, const TimeIntegrator &integrator);

  void begin() override { step(); }
  void step() override;

  /// For each limit that was passed: when it was for the first time, and how far at most.
  void finish(RunOutcome &outcome) override;
  void exchange(StateArchive &archive) override;

private:
  /// A signal that should not fall below zero after `offset` was added and `sign` taken.
  struct Limit
  {
    Signal      signal;
    double      sign = 1., offset = 0.;
    std::string object, id, what, advice;
    double      t = 0., value = 0.; ///< of the step before
    bool        known = false, passed = false;
    double      first = 0., lowest = 0.;
  };

  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  std::vector<Limit>    limits_;
  Eigen::VectorXd       none_; ///< the signals are those of elements and read no coordinates
};

} // namespace gestell::coupling
