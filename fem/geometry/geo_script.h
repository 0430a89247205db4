#pragma once

#include "fem/values/geo_tokens.h"

#include <cstddef>
#include <vector>

namespace gestell::fem
{

/**
 * Judges a script of gmsh, which may run programs, write files and read any: only what draws, sizes and meshes passes.
 *
 * A list of what is allowed decides: words of gmsh's language (4.8), options of Mesh and Geometry and a few of General,
 * kinds of size fields; any other word must be a variable by its place, for gmsh takes a word before a text, a number
 * or another word for a command.
 *
 * @param refuse  called with the line and the reason
 * @return        indices of the texts that name files, of Include, Merge and ShapeFromFile
 */
std::vector<std::size_t> judge_geo(const std::vector<GeoToken> &tokens, const RefuseLine &refuse);

} // namespace gestell::fem
