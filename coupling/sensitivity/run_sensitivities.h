#pragma once

#include "coupling/sensitivity/output_derivatives.h"
#include "coupling/sensitivity/parameter_twins.h"
#include "coupling/simulation/run_result.h"
#include "coupling/simulation/trajectory.h"

#include <atomic>
#include <string>
#include <vector>

namespace gestell::coupling
{

struct RunSensitivities
{
  std::vector<OutputDerivatives> outputs;
  std::vector<std::string>       warnings;
  bool                           interrupted = false; ///< outputs after `reached` have no derivatives
  double                         reached     = 0.;    ///< [s]
  long                           steps       = 0;     ///< of the variational equations
  double                         wall_s      = 0.;
};

/// Input of run_sensitivities().
struct SensitivityProblem
{
  Machine                           &machine; ///< of the run; its history is changed
  const std::vector<Signal>         &signals;
  const RunOptions                  &options;
  const RunResult                   &run;
  const Trajectory                  &trajectory;
  const std::vector<ParameterTwins> &twins;
  const std::atomic<bool>           *stop = nullptr; ///< ends the pass, which retains its results so far; null: none
};

/**
 * Derivatives of run results by parameters: largest and smallest value of every signal and their instants, values
 * at the end, times of events.
 *
 * At an event, the zero of an event function g located at t_e,
 *
 *     dt_e = -(g_x + grad g . s)/g',     s'_behind = s'_before + (q''_before - q''_behind) dt_e,
 *
 * and histories of elements depend on the time and the motion of each transition: those of the two machines of a
 * parameter are updated along the motion, at x -+ step.  A largest value at t* has the partial derivative at t*, its
 * instant -(dy/dx)'/y''; a value at an event has dy/dx + y' dt_e.
 *
 * @throws std::invalid_argument if the machines of a parameter have another structure, for events that were not
 * located, velocity jumps, or unsupported elements; ConvergenceFailure
 *
 * Source: docs/theory/sensitivities.md (7) to (11).
 */
RunSensitivities run_sensitivities(const SensitivityProblem &problem);

} // namespace gestell::coupling
