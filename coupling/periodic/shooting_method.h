#pragma once

#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// "shooting": Newton on the motion over one period (5.5.4/1), after some periods of lead-in.
const PeriodicMethod &shooting_method();

} // namespace gestell::coupling
