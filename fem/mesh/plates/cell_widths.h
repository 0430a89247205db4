#pragma once

#include "fem/mesh/plates/sheets.h"

#include <vector>

namespace gestell::fem
{

/**
 * Limits of the cells of a sheet [m], from its first to its last plane.
 *
 * Along both planes, where walls end or meet, the width of cells is 0.7 of the wall thickness, or a sixteenth of the
 * size if that is less: the shear of a twisted open section reverses within one thickness of an edge, and stresses are
 * singular where walls meet.  Along a plane beyond which most of the sheet continues they are three times as wide.
 * Widths grow inwards by a factor of four, up to the size.
 *
 * Through the thickness of a wall there is one cell; two if it is thicker than a quarter of the size, so that the
 * solution converges as the size decreases.
 *
 * @param size    largest width [m]
 * @param layers  smallest number of cells through a wall
 * @param even    whether the number of cells must be even
 */
std::vector<double> cell_limits(const Sheet &sheet, double size, int layers, bool even = false);

} // namespace gestell::fem
