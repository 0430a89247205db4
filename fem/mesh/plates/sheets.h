#pragma once

#include "fem/mesh/plates/brick_lattice.h"

namespace gestell::fem
{

/**
 * The connected part of the material between two adjacent planes normal to a direction: all of a sheet is divided in
 * the same way, because cells share whole faces.
 */
struct Sheet
{
  int    first = 0, last = 0; ///< planes of the lattice
  double from = 0., to = 0.;  ///< [m]
  double thickness = 0.;      ///< of the walls that form most of it [m]
  /// At `from`, `to`: whether faces cover less than half of the plane, because most of the sheet continues beyond it.
  std::array<bool, 2> mostly_goes_on{false, false};
  double              width() const { return to - from; }
};

/**
 * Sheets of the lattice normal to its three directions.  A plane divides only the sheets with a face on it: the planes
 * of a rib do not divide parts that are not connected with it there.
 */
struct Sheets
{
  std::array<std::vector<Sheet>, 3> across;
  std::array<std::vector<int>, 3>   of_brick; ///< for each brick its sheet normal to a direction, -1 for none
};

Sheets sheets_of(const BrickLattice &lattice);

} // namespace gestell::fem
