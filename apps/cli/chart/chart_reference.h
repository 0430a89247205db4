#pragma once

#include "apps/cli/chart/reference_file.h"
#include "apps/cli/chart/work_measurement.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// What errors are measured against.
struct Reference
{
  SignalSamples           values;
  double                  error = 0.; ///< of the reference itself, by scaled_error()
  double                  cpu_s = 0.;
  std::string             how;
  coupling::MethodOptions method; ///< of its coarsest run, good for the size of the motion
};

/**
 * A fine run with located events: exact propagation by collocation of order 8, controlled; its error is the largest
 * distance from two others, one with the tenfold tolerance and one of order 6.  Where exact propagation cannot treat
 * the machine, or does not get to the end, BDF of controlled order does it, with ever larger tolerances, and at last
 * BDF 2 with fixed steps; `notes` tells why.  Without values if none gets to the end.
 */
Reference own_reference(const WorkProblem &problem, std::vector<std::string> &notes);

/// The file as reference for the given signals; its error is its distance from our own reference.
Reference compared(const ReferenceFile &file, const std::vector<coupling::Signal> &signals, const Reference &own);

} // namespace gestell::apps
