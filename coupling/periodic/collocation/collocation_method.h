#pragma once

#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/// "collocation": one motion near the guess; the mesh is divided where forces are far from a polynomial, and has points
/// at the events of the motion.
const PeriodicMethod &collocation_method();

} // namespace gestell::coupling
