#pragma once

#include "coupling/frame/reduced_frame.h"

namespace gestell::apps
{

/**
 * A frame reduced by Craig-Bampton with the first of its fixed-interface modes alone: the leading blocks of M, B, C and
 * of all rows.  These modes have M_LL = E, diagonal C_LL and no stiffness to the interface, so what they carried of a
 * unit field of acceleration goes into the rows under it, f_j/omega_j^2 each. A damping ratio stays that of the modes
 * of the whole frame.  Frequencies and their errors stay those of the whole frame, too, as many as there are
 * coordinates.
 *
 * @param frame    with nothing but modes behind the interface.
 * @param n_modes  at most as many as it has
 */
coupling::ReducedFrame with_first_modes(coupling::ReducedFrame frame, int n_modes);

} // namespace gestell::apps
