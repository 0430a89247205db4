#pragma once

#include "fem/geometry/face.h"
#include "fem/values/mesh.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/// The name of a solid or a face, from gmsh's label, which starts with the parent parts: "Shapes/frame/foot".
std::string name_in_label(const std::string &label);

/**
 * The faces of gmsh's geometry that bound exactly one solid, by tag, recognised.
 *
 * @param unit      length of gmsh's unit [m]
 * @param diagonal  of the model [m]
 */
std::vector<Face> outer_faces(double unit, double diagonal);

/// The same for faces between two solids.
std::vector<Face> inner_faces(double unit, double diagonal);

/**
 * The surfaces of a mesh without geometry, from the skin's triangles: normals are those of the facets.
 *
 * @param skin_surface  for each triangle of mesh.skin the tag of its surface, 0 if it has none
 * @param divided       groups of the surfaces that gmsh does not know, see divide_skin()
 */
std::vector<Face> faces_of_skin(const Mesh &mesh, const std::vector<int> &skin_surface,
                                const std::map<int, std::vector<std::string>> &divided);

} // namespace gestell::fem
