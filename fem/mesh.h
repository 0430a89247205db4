#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace gestell::fem
{

using Point3 = std::array<double, 3>; ///< [m]

/// Tetrahedral mesh of a frame, straight edges, SI.  Triangles are ordered so that their normal points outwards.
struct Mesh
{
  std::vector<Point3>             points;
  std::vector<std::array<int, 4>> cells;      ///< positively oriented
  std::vector<int>                cell_solid; ///< index of the solid a cell belongs to
  std::vector<std::array<int, 3>> skin;       ///< every outer triangle
  std::vector<std::string>        solids;     ///< names, as in the CAD file where it has them

  /// Named surfaces: triangles of the skin, as indices into `skin`.
  std::map<std::string, std::vector<int>> surfaces;
};

} // namespace gestell::fem
