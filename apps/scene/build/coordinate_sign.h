#pragma once

#include "coupling/machine/machine.h"

namespace gestell::apps
{

/// Of the motion that coordinate_name() names, in coordinate i: -1 where a frame from matrices has the opposite motion
/// ("-uz") in its row.
double coordinate_sign(const coupling::Machine &machine, int i);

} // namespace gestell::apps
