#pragma once

#include "coupling/frame/reduced_frame.h"

namespace gestell::apps
{

/**
 * Truncates a frame reduced by Craig-Bampton to its first fixed-interface modes: the leading blocks of M, B, C and of
 * all rows.  Fixed-interface modes have M_LL = E, diagonal C_LL and no stiffness coupling to the interface, so the
 * static response f_j/omega_j^2 of each removed mode to a unit acceleration is added to the rows for that acceleration,
 * and that to inertia and damping to the rows of forces (docs/theory/reduction.md (7a)), unless the given ones lack it.
 * The damping ratio remains that of the modes of the given frame.  Its frequencies and their errors are copied, as many
 * as the truncated frame has coordinates.
 *
 * @param frame    its coordinates are the interface and modes, nothing else.
 * @param n_modes  at most the number of its modes
 */
coupling::ReducedFrame with_first_modes(coupling::ReducedFrame frame, int n_modes);

} // namespace gestell::apps
