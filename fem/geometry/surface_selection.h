#pragma once

#include "fem/geometry/face.h"
#include "fem/values/frame_specification.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * The faces selected by a selector, by tag, ascending.
 *
 * A face matches if it satisfies every given condition within the tolerance (default 1e-4 of the model's diagonal): all
 * its samples are on the given plane, with the given outward normal, or at the given radius from the axis; its box is
 * in the given box; its group, its name or the last part of its name is the given one.
 *
 * Matching faces that share an edge are one piece: a bore of two halves, or of two lengths, is one face to its user;
 * pieces are selected as a whole.  `faces` is the number of pieces, or of faces.
 *
 * `through` gives a plane or an axis.  Only if more pieces match than `selector.faces`, it also selects by position:
 * the pieces whose extent (along the axis; within the plane) contains the point. So the point chooses between separate
 * pieces, or the selection fails; it never selects a part of a piece.
 *
 * @throws std::invalid_argument with the candidates if no face matches or their number is not `faces`.
 */
std::vector<int> select_faces(const std::vector<Face> &faces, const SurfaceSelector &selector, double diagonal);

/// "face 4; coaxial faces not selected: 7 (radius 0.12 m)": the faces selected by a cylinder and the other coaxial
/// cylinders of any radius; empty if there is only one face.
std::string coaxial_faces(const std::vector<Face> &faces, const SurfaceSelector &selector,
                          const std::vector<int> &selected, double diagonal);

} // namespace gestell::fem
