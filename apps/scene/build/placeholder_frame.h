#pragma once

#include "apps/scene/values/requests.h"
#include "coupling/frame/reduced_frame.h"

namespace gestell::apps
{

/// A frame with the interfaces and outputs of the one that must be computed first, and no physics: M = C = E.
coupling::ReducedFrame placeholder_frame(const Scene &scene);

/**
 * The same as a rigid body that moves as far as its supports let it, with the mass of one kilogram at each coordinate,
 *
 *     C = (2 pi f)^2 (E - Q Q^T),     Q an orthonormal basis of its free rigid motions, named in facts.free_motions.
 *
 * Free are the translations that no support of a frame from geometry resists, with its rotations if it has no support;
 * of a frame from matrices, the translations without elastic energy.
 */
coupling::ReducedFrame rigid_stand_in(const Scene &scene);

} // namespace gestell::apps
