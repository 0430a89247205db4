#pragma once

#include "coupling/periodic/periodic_method.h"

namespace gestell::coupling
{

/**
 * All solutions of (5.5.4/2), F -> 0, from many starts.
 *
 * Starts lie in a box about the motion that the guess leads to, reach times as wide, by Halton's sequence; each second
 * one is integrated for some periods before.  From each the least squares of the shooting equations are found by
 * Levenberg and Marquardt's method (Eigen's, which takes exact derivatives and needs no library of its own), then
 * Newton's.  Solutions are told apart at any phase of the excitation; sub-harmonic motions of up to `highest_ratio`
 * periods are looked for by the way.
 *
 * The last quarter of the starts keeps off the motions that are known (Deflation), and so finds others whose basins are
 * small; shares are those of the other starts alone.
 */
const PeriodicMethod &minimising_method();

} // namespace gestell::coupling
