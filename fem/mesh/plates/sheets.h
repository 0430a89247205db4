#pragma once

#include "fem/mesh/plates/brick_lattice.h"

namespace gestell::fem
{

/**
 * What two neighbouring planes across a direction cut out of the material, as far as it hangs together between them:
 * all of a sheet is divided alike, as cells share whole faces.
 */
struct Sheet
{
  int    first = 0, last = 0; ///< planes of the lattice
  double from = 0., to = 0.;  ///< [m]
  double thickness = 0.;      ///< of the walls that make up most of it [m]
  /// At `from`, `to`: whether faces lie on less than half of the plane, most of what it cuts going on beyond it.
  std::array<bool, 2> mostly_goes_on{false, false};
  double              width() const { return to - from; }
};

/**
 * Sheets of the lattice across its three directions.  A plane cuts only those sheets in which a face lies on it: the
 * planes of a rib do not divide what does not hang together with it there.
 */
struct Sheets
{
  std::array<std::vector<Sheet>, 3> across;
  std::array<std::vector<int>, 3>   of_brick; ///< for each brick the sheet across a direction, -1 for none
};

Sheets sheets_of(const BrickLattice &lattice);

} // namespace gestell::fem
