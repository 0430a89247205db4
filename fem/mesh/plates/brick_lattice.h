#pragma once

#include "fem/mesh/plates/plate_faces.h"

#include <array>
#include <cstddef>
#include <vector>

namespace gestell::fem
{

using Index3 = std::array<int, 3>;

/// Bricks around holes that are swept together along a direction: no plane normal to the other directions divides them.
struct SweptRegion
{
  int              direction = 0;
  Index3           from{}, to{}; ///< bricks, `to` is beyond the last
  std::vector<int> holes;        ///< into PlateSolids::holes
};

/**
 * Bricks between all planes of the faces, with the solid of each.  Coordinates are those of the solids' axes.
 */
struct BrickLattice
{
  std::array<std::vector<double>, 3> planes; ///< ascending [m]
  std::vector<int>                   solid;  ///< of each brick, -1 for none
  std::vector<int>                   region; ///< of each brick, -1 for none
  std::vector<SweptRegion>           regions;

  int         n(int direction) const { return static_cast<int>(planes[direction].size()) - 1; }
  std::size_t size() const { return solid.size(); }
  std::size_t index(const Index3 &i) const { return (static_cast<std::size_t>(i[2]) * n(1) + i[1]) * n(0) + i[0]; }
  Index3      place(std::size_t brick) const
  {
    const int nx = n(0), ny = n(1), row = static_cast<int>(brick / nx);
    return {static_cast<int>(brick % nx), row % ny, row / ny};
  }
  /// -1 outside the lattice
  int at(const Index3 &i) const
  {
    for (int d = 0; d < 3; ++d)
      if (i[d] < 0 || i[d] >= n(d))
        return -1;
    return solid[index(i)];
  }
  /// Whether planes normal to the direction may divide the brick.
  bool is_divided(std::size_t brick, int direction) const
  {
    return solid[brick] >= 0 && (region[brick] < 0 || regions[region[brick]].direction == direction);
  }
  double width(int direction, int i) const { return planes[direction][i + 1] - planes[direction][i]; }
  /// The plane at this level; -1: none.
  int plane_at(int direction, double level) const;
};

/// @param more  levels of further planes, for each direction [m]
/// @throws NotSwept if solids overlap, or for too many bricks.
BrickLattice brick_lattice(const PlateSolids &solids, double diagonal,
                           const std::array<std::vector<double>, 3> &more = {});

} // namespace gestell::fem
