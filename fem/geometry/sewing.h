#pragma once

#include "fem/geometry/cad_shape.h"
#include "fem/values/cad_source.h"

#include <string>

namespace gestell::fem
{

/**
 * Joins edges of open shells that are at most source.sew apart, part by part and then all that are left together, and
 * makes solids of the closed shells; names and materials of parts stay. Closed solids remain as they are.
 *
 * @param unit  length of the shape's unit [m]
 * @return what was sewn, with the tolerance: "2 edges and 6 faces are sewn within 0.05 mm, ..."
 * @throws std::invalid_argument if the tolerance is not less than a third of the narrowest face, and so of the thinnest
 *         wall: OpenCASCADE takes two vertices for one where they are nearer than the sum of their tolerances and this
 */
std::string sew(CadShape &shape, const CadSource &source, double unit);

} // namespace gestell::fem
