#pragma once

#include "fem/mesh/plates/sheets.h"

#include <vector>

namespace gestell::fem
{

/**
 * Where a sheet is divided into cells [m], from its first to its last plane.
 *
 * Along both planes, where walls end or meet, cells are as narrow as the walls are thick, or an eighth of the size if
 * that is less: the shear of a twisted open section turns round within one thickness of an edge.  They grow inwards, up
 * to the size.
 *
 * @param size    largest width [m]
 * @param layers  cells at least through a width that is no more than the thickness of a wall
 */
std::vector<double> cell_limits(const Sheet &sheet, double size, int layers);

} // namespace gestell::fem
