#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Checks oil and gas cylinders after every step for oil pressures below zero, where cavitation occurs, and pistons at
/// the end of their stroke.  Their laws include neither.
class PistonLimits : public RunObserver
{
public:
  PistonLimits(const Machine &machine, const TimeIntegrator &integrator);

  void begin() override { step(); }
  void step() override;

  /// Adds a finding for each limit exceeded, with the time of the first violation and the largest one.
  void finish(RunOutcome &outcome) override;
  void exchange(StateArchive &archive) override;

private:
  /// sign * signal + offset, which should not fall below zero.
  struct Limit
  {
    Signal      signal;
    double      sign = 1., offset = 0.;
    std::string object, id, what, advice;
    double      t = 0., value = 0.; ///< of the previous step
    bool        known = false, passed = false;
    double      first = 0., lowest = 0.;
  };

  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  std::vector<Limit>    limits_;
  Eigen::VectorXd       none_; ///< the signals are those of elements and read no coordinates
};

} // namespace gestell::coupling
