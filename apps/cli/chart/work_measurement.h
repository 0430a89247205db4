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

/// A motion of a machine that all methods compute.
struct WorkProblem
{
  coupling::Machine            &machine;
  const coupling::InitialState &initial;
  double                        begin = 0.; ///< [s]
  std::vector<double>           samples{};  ///< [s] ascending, after begin; the last one ends the run
  std::vector<coupling::Signal> signals{};
  double                        cpu_limit = 20.; ///< [s] of one run; longer runs are aborted
  double                        repeat_s  = 0.5; ///< [s] total time for repeated runs without samples; 0: no repetition
  const std::atomic<bool>      *stop      = nullptr;
};

/// Results and cost of a run.
struct WorkRun
{
  SignalSamples             values; ///< empty if it failed
  coupling::IntegrationWork work;
  long                      events  = 0;
  double                    cpu_s   = 0.; ///< only of the steps
  double                    setup_s = 0.; ///< factorisations and tables before the first step
  std::string               failure;
};

/// Runs one of our methods.  Short runs are repeated without samples; the fastest one is used.
/// @throws std::invalid_argument if the method cannot treat the machine
WorkRun measure(const WorkProblem &problem, const coupling::MethodOptions &method, bool events);

/// The largest absolute values of q and v in a run, for the tolerances of other solvers.
struct MotionScales
{
  Eigen::VectorXd q, v; // [n]
};

/// Runs a general-purpose library.  Its absolute tolerances are options.tolerance times the scales.
WorkRun measure(const WorkProblem &problem, const peers::PeerOptions &options, const MotionScales &scales);

/// The scales of a run with the given method.  Coordinates of the same kind share the largest of their values, so that
/// a mode with negligible motion does not require unnecessary accuracy.
MotionScales motion_scales(const WorkProblem &problem, const coupling::MethodOptions &method, bool events);

/// Root mean square of the difference over signals and samples, each signal scaled by its largest magnitude in
/// `reference`; signals that are zero there are skipped.  Infinite if `values` is incomplete.
double scaled_error(const SignalSamples &values, const SignalSamples &reference);

/// The largest step for a controlled method: small enough that no load is missed between two steps.
double longest_step(const WorkProblem &problem);

} // namespace gestell::apps
