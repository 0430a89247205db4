#include "fem/mesh/plates/wall_statement.h"

#include "fem/values/message_text.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace gestell::fem
{

namespace
{

struct Walls
{
  std::set<std::pair<int, int>> sheets; // direction across, number
  std::set<std::array<int, 3>>  bricks;
  double                        thinnest = 1e300, thickest = 0., volume = 0., all = 0.;
};

/// @param widths  of the sheets of a brick across the three directions
void count(const std::array<double, 3> &widths, const std::array<int, 3> &sheet, double volume, Walls &walls)
{
  const auto       thin      = static_cast<int>(std::min_element(widths.begin(), widths.end()) - widths.begin());
  const double     thickness = widths[thin];
  constexpr double slender   = 3.; // width over thickness of a wall: less is a block
  if (std::min(widths[(thin + 1) % 3], widths[(thin + 2) % 3]) < slender * thickness)
    return;
  walls.sheets.insert({thin, sheet[thin]});
  walls.thinnest = std::min(walls.thinnest, thickness);
  walls.thickest = std::max(walls.thickest, thickness);
  walls.volume += volume;
}

std::string number(int n, const std::string &what)
{
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

} // namespace

void WallCount::add(const WallCount &other)
{
  walls += other.walls;
  bricks += other.bricks;
  regions += other.regions;
  thinnest = std::min(thinnest, other.thinnest);
  thickest = std::max(thickest, other.thickest);
  volume += other.volume;
  all += other.all;
}

WallCount count_walls(const BrickLattice &lattice, const Sheets &sheets)
{
  Walls walls;
  for (std::size_t brick = 0; brick < lattice.size(); ++brick)
  {
    if (lattice.solid[brick] < 0)
      continue;
    const Index3          i = lattice.place(brick);
    std::array<double, 3> widths;
    std::array<int, 3>    sheet;
    double                volume = 1.;
    for (int d = 0; d < 3; ++d)
    {
      volume *= lattice.width(d, i[d]);
      sheet[d]  = sheets.of_brick[d][brick];
      widths[d] = sheet[d] >= 0 ? sheets.across[d][sheet[d]].width() : 1e300; // around a hole
    }
    walls.all += volume;
    if (lattice.region[brick] < 0)
      walls.bricks.insert(sheet);
    count(widths, sheet, volume, walls);
  }
  return {static_cast<int>(walls.sheets.size()),
          static_cast<int>(walls.bricks.size()),
          static_cast<int>(lattice.regions.size()),
          walls.thinnest,
          walls.thickest,
          walls.volume,
          walls.all};
}

std::string wall_statement(const WallCount &walls, int n_extruded, bool alone)
{
  const std::string along =
      number(n_extruded, "solid") + " swept along " + (n_extruded == 1 ? "its axis" : "their axes");
  if (walls.bricks + walls.regions == 0)
    return "hexahedra: " + along;
  const std::string pieces =
      number(walls.bricks, "brick") +
      (walls.regions == 0 ? "" : " and " + number(walls.regions, "region") + " around holes and footprints") +
      (n_extruded == 0 ? "" : ", of " + along) + (alone ? ", without tetrahedra" : ", and of tetrahedra");
  if (walls.walls == 0)
    return "plates are meshed by sweeping: none is three times as wide as thick; the mesh consists of " + pieces;
  const bool alike = walls.thickest - walls.thinnest < 1e-6 * walls.thickest;
  return "plates are meshed by sweeping: " + number(walls.walls, "wall") + ", " +
         (alike ? "" : text(1e3 * walls.thinnest) + " to ") + text(1e3 * walls.thickest) + " mm thick, are " +
         text(std::round(100. * walls.volume / walls.all)) + " % of their volume; the mesh consists of " + pieces;
}

} // namespace gestell::fem
