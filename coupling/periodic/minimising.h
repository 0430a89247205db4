#pragma once

#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/**
 * All solutions of (5.5.4/2), F -> 0, from many initial states in a box about the motion reached from the guess, reach
 * times as wide, by Halton's sequence; each second one is integrated for some periods before.  From each the least
 * squares of the shooting equations are found by Levenberg and Marquardt's method (Eigen's, which takes exact
 * derivatives and needs no library of its own), then Newton's.  Solutions are distinguished at any phase of the
 * excitation; subharmonic solutions of up to `highest_ratio` periods are included. The last quarter of the initial
 * states deflates known solutions (Deflation), to find others with small basins; shares refer to the other initial
 * states only.
 */
const PeriodicMethod &minimising_method();

} // namespace gestell::coupling
