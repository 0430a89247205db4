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
 * Keeps the states around extremes of signals, of which only the end of a run knows where they are: on three scales,
 * each eight times as coarse as the one before, the last ones in a ring, and of these as many on both sides of an
 * extreme as belong to it.  The finest scale parts the run into 20 000.
 */
class StatesAround
{
public:
  StatesAround(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
               const std::vector<SignalSummary> &signals, KeptStates &kept);

  /// At the start and after a step, when the extremes of the signals are known.
  void follow();
  void finish(); ///< fills KeptStates::around

  void exchange(StateArchive &archive);

private:
  /// A grid of instants and the latest states on it.
  struct Scale
  {
    double                              spacing = 0.;
    long                                next    = 0;
    std::vector<KeptState>              ring{};
    std::vector<std::vector<KeptState>> kept{}; ///< by extreme: left the ring, and lie around it

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
  std::vector<double>               seen_; ///< [s] the extremes at the last call
  LocalState                        local_;
};

} // namespace gestell::coupling
