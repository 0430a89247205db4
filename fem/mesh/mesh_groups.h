#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/extracted_mesh.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Gives surfaces to a skin that has none, or not enough: without named surfaces in the file, triangles are connected
 * across edges with a bend of less than 40 degrees; surfaces end where a group of nodes or faces ends. A face is part
 * of a group of nodes if all its corners are.
 *
 * @return  names of the groups of each new surface, by its tag
 */
std::map<int, std::vector<std::string>> divide_skin(ExtractedMesh &extracted, const MeshGroups &groups);

} // namespace gestell::fem
