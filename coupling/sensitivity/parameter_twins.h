#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"

#include <limits>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// The machine at another value of one parameter, with its start and its signals.
struct MachineTwin
{
  Machine            *machine = nullptr;
  InitialState        initial;
  std::vector<Signal> signals;                                         ///< those of the run, in the same order
  double              end  = 0.;                                       ///< [s] of the run
  double              from = -std::numeric_limits<double>::infinity(); ///< [s] see RunOptions
};

/// A parameter and the machine at x - step and x + step, of one structure: coordinates, measures, joints, elements.
/// Derivatives at a fixed motion are quotients of the two; their own motions are never computed.
struct ParameterTwins
{
  std::string key;  ///< "parameters.c_P"
  std::string unit; ///< "N/m", of SI
  double      value = 0.;
  double      step  = 0.; ///< > 0
  MachineTwin minus, plus;
};

} // namespace gestell::coupling
