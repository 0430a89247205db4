#pragma once

#include "coupling/integration/system/time_integrator.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

class StateArchive;

/**
 * Keeps the states around extremes of signals, whose times are known only at the end of a run.  It samples on three
 * time scales, the finest with 20 000 intervals per run, each of the others eight times as coarse.  Each scale has a
 * ring buffer of its latest states, and keeps the same number of states before and after each extreme.
 */
class StatesAround
{
public:
  StatesAround(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
               const std::vector<SignalSummary> &signals, KeptStates &kept);

  /// Called at the start and after a step, when the extremes of the signals are known.
  void follow();
  void finish(); ///< fills KeptStates::around

  void exchange(StateArchive &archive);

private:
  /// A time grid and the latest states on it.
  struct Scale
  {
    double                              spacing = 0.;
    long                                next    = 0;
    std::vector<KeptState>              ring{};
    std::vector<std::vector<KeptState>> kept{}; ///< by extreme: states near it that have left the ring

    void exchange(StateArchive &archive);
  };

  double time_of(std::size_t extreme) const;
  void   store(double t, Scale &scale);
  void   leave(const KeptState &state, Scale &scale);
  void   forget();

  const Machine                    &machine_;
  const TimeIntegrator             &integrator_;
  const std::vector<SignalExtreme> &wanted_;
  const std::vector<SignalSummary> &signals_;
  KeptStates                       &kept_;
  double                            begin_;
  std::vector<Scale>                scales_;
  std::vector<double>               seen_; ///< [s] times of the extremes at the last call
  LocalState                        local_;
};

} // namespace gestell::coupling
