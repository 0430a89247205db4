#pragma once

#include "fem/recovery/discretisation.h"

namespace gestell::fem
{

/**
 * The frame in elements of degree three on the same mesh, as a separate frame:
 *
 *     M3, C3 by MeshError::raised(),   B3 = P B P^T + beta (C3 - P C P^T) + alpha (M3 - P M P^T),
 *
 * P [n3 x n] puts the coordinates of the quadratics at their places; interfaces, rigid motions, picture and outputs go
 * there with them.  Forces through cuts and on clamped supports, which include cubic parts, are omitted, as are
 * stresses.
 *
 * @param specification  its Rayleigh damping is alpha and beta.
 *
 * Source: docs/theory/mesh_error.md (4a).
 */
FrameMatrices raised_matrices(const Discretisation &quadratic, const FrameSpecification &specification);

} // namespace gestell::fem
