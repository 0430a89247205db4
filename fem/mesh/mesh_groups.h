#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Gives surfaces to a skin that has none, or not enough: where the file names no surface, triangles hang together
 * across edges that bend by less than 40 degrees; where a group of nodes or faces ends, a surface ends.  A face belongs
 * to a group of nodes if all its corners do.
 *
 * @return  names of the groups of each new surface, by its tag
 */
std::map<int, std::vector<std::string>> divide_skin(ExtractedMesh &extracted, const MeshGroups &groups);

} // namespace gestell::fem
