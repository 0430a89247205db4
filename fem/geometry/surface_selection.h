#pragma once

#include "fem/geometry/face.h"
#include "fem/values/frame_specification.h"

#include <vector>

namespace gestell::fem
{

/**
 * The faces a selector means, by tag, ascending.
 *
 * A face fits if every given condition holds within the tolerance (default 1e-4 of the model's diagonal): all its
 * samples lie on the wanted plane, with the wanted outward normal, or at the wanted radius from the axis; its box
 * lies in the wanted box; its group, its name or the last part of its name is the wanted one.
 *
 * `through` gives a plane or an axis.  Only if more faces fit than `selector.faces` asks for, it is also read as a
 * place: those faces count whose extent (along the axis; within the plane) holds the point, if their number is right.
 *
 * Faces that share an edge may count as one: a bore of two halves is one face to its user.
 *
 * @throws std::invalid_argument with the candidates if no face fits or their number is another one than `faces`.
 */
std::vector<int> select_faces(const std::vector<Face> &faces, const SurfaceSelector &selector, double diagonal);

} // namespace gestell::fem
