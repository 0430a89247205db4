#pragma once

#include "coupling/integration/events/run_observer.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/resumable_run.h"

#include <vector>

namespace gestell::coupling
{

class TimeIntegrator;

/**
 * Monitors signals of a run without rows in its history: value at the start and at the end, and extremes.
 *
 * The values are compared with scales of the machine, so that sampling every eighth step suffices: with at least ten
 * steps per period of a vibration, a sampled extreme is too small by less than a factor of two.
 */
class WatchedValues : public RunObserver
{
public:
  /// @param watched      receives the values; null: not active
  /// @param coordinates  read by its signals
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
