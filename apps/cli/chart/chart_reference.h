#pragma once

#include "apps/cli/chart/reference_file.h"
#include "apps/cli/chart/work_measurement.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Reference solution for the errors.
struct Reference
{
  SignalSamples           values;
  double                  error = 0.; ///< of the reference itself, by scaled_error()
  double                  cpu_s = 0.;
  std::string             how;
  coupling::MethodOptions method; ///< method of its coarsest run, accurate enough for the magnitude of the motion
};

/**
 * A fine run with located events: exact propagation by collocation of order 8 with error control.  Its error is the
 * largest difference to two other runs, one with ten times the tolerance and one of order 6.  If exact propagation
 * cannot treat the machine, or does not reach the end, BDF of variable order is used with increasing tolerances, and
 * finally BDF 2 with fixed steps; `notes` lists the reasons.  Without values if no method reaches the end.
 */
Reference own_reference(const WorkProblem &problem, std::vector<std::string> &notes);

/// The file as reference for the given signals; its error is its difference to our own reference.
Reference compared(const ReferenceFile &file, const std::vector<coupling::Signal> &signals, const Reference &own);

} // namespace gestell::apps
