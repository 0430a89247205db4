#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/frame/reduced_frame.h"

namespace gestell::apps
{

/// A frame with the interfaces and outputs of one that must be computed first, without physics: M = C = E.
coupling::ReducedFrame placeholder_frame(const Scene &scene);

/**
 * The same as a rigid body that moves as its supports allow, with a mass of one kilogram at each coordinate,
 *
 *     C = (2 pi f)^2 (E - Q Q^T),     Q an orthonormal basis of its rigid-body modes, listed in facts.free_motions.
 *
 * Rigid-body modes of a frame from geometry are the translations that no support resists, and the rotations if it has
 * no support; those of a frame from matrices are the translations without elastic energy.
 */
coupling::ReducedFrame rigid_stand_in(const Scene &scene);

} // namespace gestell::apps
