#pragma once

#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// "averaging": every steady amplitude of the slow flow, each as a series of one harmonic with the multipliers of the
/// flow.
const PeriodicMethod &averaging_method();

} // namespace gestell::coupling
