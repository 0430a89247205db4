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

Walls walls_of(const BrickLattice &lattice, const Sheets &sheets)
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
  return walls;
}

std::string number(std::size_t n, const std::string &what)
{
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

} // namespace

std::string wall_statement(const BrickLattice &lattice, const Sheets &sheets)
{
  const Walls       walls = walls_of(lattice, sheets);
  const std::string pieces =
      number(walls.bricks.size(), "brick") +
      (lattice.regions.empty() ? "" : " and " + number(lattice.regions.size(), "region") + " around holes");
  if (walls.sheets.empty())
    return "plates are swept: none is three times as wide as thick; the mesh consists of " + pieces;
  const bool alike = walls.thickest - walls.thinnest < 1e-6 * walls.thickest;
  return "plates are swept: " + number(walls.sheets.size(), "wall") + ", " +
         (alike ? "" : text(1e3 * walls.thinnest) + " to ") + text(1e3 * walls.thickest) + " mm thick, are " +
         text(std::round(100. * walls.volume / walls.all)) + " % of the volume; the mesh consists of " + pieces +
         ", without tetrahedra";
}

} // namespace gestell::fem
