#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/resumable_run.h"

#include <vector>

namespace gestell::coupling
{

class TimeIntegrator;

/**
 * Follows signals of a run that have no rows in its history: value at the start and at the end, extremes between.
 *
 * They are compared with sizes of the machine, so that every eighth step is enough: with the ten and more steps in a
 * period that a vibration needs, a sampled extreme is below the true one by less than a factor of two.
 */
class WatchedValues : public RunObserver
{
public:
  /// @param watched      gets the values; null: nothing to do
  /// @param coordinates  that its signals read
  WatchedValues(const Machine &machine, const TimeIntegrator &integrator, WatchedSignals *watched,
                std::vector<int> coordinates);

  void begin() override { look(); }
  void step() override;
  void finish(RunOutcome &) override { look(); } ///< the value at the present instant is the last one

  void exchange(StateArchive &archive) override;

private:
  void look();

  const Machine        &machine_;
  const TimeIntegrator &integrator_;
  WatchedSignals       *watched_;
  std::vector<int>      coordinates_;
  Eigen::VectorXd       q_, v_;
  long                  steps_ = 0;
};

} // namespace gestell::coupling
