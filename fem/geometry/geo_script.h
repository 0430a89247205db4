#pragma once

#include "fem/values/geo_tokens.h"

#include <cstddef>
#include <vector>

namespace gestell::fem
{

/**
 * Checks a gmsh script, which may run programs, write files and read any: only drawing, sizing and meshing is accepted.
 * The allow-list contains words of gmsh's language (4.8), options of Mesh and Geometry and a few of General, and kinds
 * of size fields; any other word must be a variable by its position, since gmsh reads a word before a string, a number
 * or another word as a command.
 *
 * @param refuse  called with the line and the reason
 * @return        indices of the strings that name files, of Include, Merge and ShapeFromFile
 */
std::vector<std::size_t> judge_geo(const std::vector<GeoToken> &tokens, const RefuseLine &refuse);

} // namespace gestell::fem
