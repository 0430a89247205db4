#pragma once

#include "coupling/machine/accelerations.h"
#include "coupling/machine/machine.h"
#include "coupling/simulation/checks/energy_check.h"
#include "coupling/simulation/extreme_states.h"
#include "coupling/simulation/run_result.h"
#include "coupling/simulation/signal_extremes.h"
#include "coupling/simulation/states_around.h"

#include <optional>
#include <vector>

namespace gestell::coupling
{

/// Why a motion is invalid: a coordinate or its rate is not finite; "" if all are.
std::string non_finite_state_message(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);

/// Coordinates whose positions or rates signals read, ascending.
std::vector<int> coordinates_of(const std::vector<Signal> &signals);

/**
 * Records a run: extremes of all signals, rows of the history, states for pictures, and the energy balance.
 *
 * Rows and pictures have separate time grids, evaluated by dense output.  Rows are also samples for the extremes, in
 * addition to those of SignalExtremes.
 *
 * At an instant with events two states are recorded: the one just before the first event, and the one after the last,
 * which is recorded with the next step.  States between them have no duration: a rod without clearance is slack between
 * compression and tension, and a sticking element above its limit slips at once.
 */
class Recorder : public RunObserver, private SampledRun
{
public:
  Recorder(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
           const std::vector<Signal> &signals, const Sampling &sampling, RunResult &result);

  void begin() override;
  void step() override;
  void event(const Event &event) override;
  void finish(RunOutcome &outcome) override; ///< the last instant always has a row

  void exchange(StateArchive &archive) override; ///< also the records in the result

private:
  void          evaluate(double t, SignalSample &sample) override;
  void          tell(double t, const LocalState &local, SignalSample &sample);
  void          settle();
  void          settle_at_end(RunOutcome &outcome);
  void          values_before();
  void          values_behind();
  void          follow_briefly();
  void          rows();
  void          row(double t, const SignalSample &sample, const EnergySummary &energy);
  EnergySummary energy_inside(double t);
  void          balance();
  void          pictures();
  void          picture(double t);
  void          picture_event();

  const Machine               &machine_;
  const TimeIntegrator        &integrator_;
  const RunOptions            &options_;
  const std::vector<Signal>   &signals_;
  RunResult                   &result_;
  ExtremeStates                keeper_;
  StatesAround                 around_;
  std::optional<EnergyCheck>   energy_;
  std::vector<int>             coordinates_; ///< that signals read
  Instant                      between_;
  Eigen::VectorXd              a_, p_;
  std::optional<Accelerations> accelerations_; ///< if a signal reads any
  SignalExtremes               extremes_;
  SignalSample                 probe_;            ///< scratch
  LocalState                   after_;            ///< the motion after the last event
  bool                         pending_  = false; ///< and it has not been recorded yet
  double                       length_   = 0.;    ///< of the last recorded step
  double                       row_step_ = 0., picture_step_ = 0.;
  std::size_t                  settled_  = 0;                    ///< events with recorded values after them
  long                         next_row_ = 0, next_picture_ = 0; ///< indices on their grids
  double                       close_until_  = 0.;               ///< [s] until then pictures are dense
  long                         close_budget_ = 0;                ///< remaining number of dense pictures
};

} // namespace gestell::coupling
