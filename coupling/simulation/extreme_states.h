#pragma once

#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

class StateArchive;

/// Takes the requested states from the dense output at their exact instants, not from the ends of steps.  Without a
/// request a step costs one comparison.
class ExtremeStates
{
public:
  ExtremeStates(const Machine &machine, const TimeIntegrator &integrator, const StateRequest &request, double begin,
                const std::vector<SignalSummary> &signals, KeptStates &kept);

  /// Called at the start, after a step and after an event, when the extremes of the signals are known.
  void follow();

  void exchange(StateArchive &archive);

private:
  Eigen::VectorXd state(double t);

  const Machine                    &machine_;
  const TimeIntegrator             &integrator_;
  const StateRequest               &request_;
  const std::vector<SignalSummary> &signals_;
  KeptStates                       &kept_;
  bool                              idle_;
  double                            begin_;
  std::size_t                       next_at_ = 0;
  Eigen::VectorXd                   q_, v_, p_;
  LocalState                        local_;
};

} // namespace gestell::coupling
