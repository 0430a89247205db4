#pragma once

#include "fem/recovery/discretisation.h"

namespace gestell::fem
{

/**
 * The frame in elements of degree three on the same mesh, as a separate frame:
 *
 *     M3, C3 by MeshError::raised(),   B3 = P B P^T + beta (C3 - P C P^T) + alpha (M3 - P M P^T),
 *
 * where P [n3 x n] maps the coordinates of the quadratics to their new indices; interfaces, rigid-body modes, picture
 * and outputs are renumbered with them.  Forces through cuts and on clamped supports, which include cubic parts, are
 * omitted, as are stresses.
 *
 * @param specification  its Rayleigh damping is alpha and beta.
 *
 * Source: docs/theory/mesh_error.md (4a).
 */
FrameMatrices raised_matrices(const Discretisation &quadratic, const FrameSpecification &specification);

} // namespace gestell::fem
