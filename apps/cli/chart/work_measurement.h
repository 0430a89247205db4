#pragma once

#include "apps/peers/peer.h"
#include "coupling/equilibrium/steady_start.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/machine/machine.h"

#include <atomic>
#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Signals at the instants of the samples, [n_signals x n_samples].
using SignalSamples = Eigen::MatrixXd;

/// One motion of a machine that all methods compute.
struct WorkProblem
{
  coupling::Machine            &machine;
  const coupling::InitialState &initial;
  double                        begin = 0.; ///< [s]
  std::vector<double>           samples{};  ///< [s] ascending, after begin; the last one ends the run
  std::vector<coupling::Signal> signals{};
  double                        cpu_limit = 20.; ///< [s] of one run; longer ones are given up
  double repeat_s               = 0.5; ///< [s] a run is timed again without samples, shorter ones for so long; 0: not
  const std::atomic<bool> *stop = nullptr;
};

/// What a run gave and what it cost.
struct WorkRun
{
  SignalSamples             values; ///< empty if it failed
  coupling::IntegrationWork work;
  long                      events  = 0;
  double                    cpu_s   = 0.; ///< stepping alone
  double                    setup_s = 0.; ///< factorisations and tables made before the first step
  std::string               failure;
};

/// Runs one of our methods.  Short runs are repeated without samples, the fastest counts.
/// @throws std::invalid_argument if the method cannot treat the machine
WorkRun measure(const WorkProblem &problem, const coupling::MethodOptions &method, bool events);

/// The largest absolute value of q and v in a run, for the tolerances of peers.
struct MotionScales
{
  Eigen::VectorXd q, v; // [n]
};

/// Runs a general-purpose library.  Its absolute tolerances are options.tolerance times the scales.
WorkRun measure(const WorkProblem &problem, const peers::PeerOptions &options, const MotionScales &scales);

/// The scales of a run by the given method: coordinates of one kind share theirs, the largest among them, so that a
/// mode that hardly moves does not ask for more accuracy than is of use.
MotionScales motion_scales(const WorkProblem &problem, const coupling::MethodOptions &method, bool events);

/// Root mean square over signals and samples of the difference, each signal scaled by its largest magnitude in
/// `reference`; signals that are zero there are left out.  Infinite if `values` is not complete.
double scaled_error(const SignalSamples &values, const SignalSamples &reference);

/// The largest step for a controlled method: no load goes by between two steps.
double longest_step(const WorkProblem &problem);

} // namespace gestell::apps
