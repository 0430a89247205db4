#pragma once

#include "fem/mesh/plates/sheets.h"

#include <vector>

namespace gestell::fem
{

/**
 * Where a sheet is divided into cells [m], from its first to its last plane.
 *
 * Along both planes, where walls end or meet, cells are 0.7 of the thickness of the walls wide, or a sixteenth of the
 * size if that is less: the shear of a twisted open section turns round within one thickness of an edge, and stresses
 * are singular where walls meet.  Along a plane beyond which most of the sheet goes on they are three times as wide.
 * They grow inwards by a factor of four, up to the size.
 *
 * Through a wall, whose width is its thickness, there is one cell; two where it is thicker than a quarter of the size,
 * so that ever smaller sizes lead to the exact solution.
 *
 * @param size    largest width [m]
 * @param layers  cells through a wall at least
 * @param even    whether the number of cells must be
 */
std::vector<double> cell_limits(const Sheet &sheet, double size, int layers, bool even = false);

} // namespace gestell::fem
