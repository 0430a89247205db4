#include "fem/mesh/plates/footprints.h"

#include <algorithm>
#include <cmath>

namespace gestell::fem
{

namespace
{

double distance_to(const Point2 &x, const Side &side)
{
  const auto &[a, b] = side;
  const double u = b[0] - a[0], v = b[1] - a[1];
  const double t = std::clamp(((x[0] - a[0]) * u + (x[1] - a[1]) * v) / (u * u + v * v), 0., 1.);
  return std::hypot(a[0] + t * u - x[0], a[1] + t * v - x[1]);
}

bool crosses(const Side &a, const Side &b)
{
  const auto side = [](const Side &s, const Point2 &x)
  { return (s[1][0] - s[0][0]) * (x[1] - s[0][1]) - (s[1][1] - s[0][1]) * (x[0] - s[0][0]); };
  return side(a, b[0]) * side(a, b[1]) < 0. && side(b, a[0]) * side(b, a[1]) < 0.;
}

/// From a face of the plate through all that lies below; empty if the plate is on both sides.
std::pair<double, double> through_plate(const BrickLattice &lattice, int d, double level, const Point2 &x)
{
  const int  plane   = lattice.plane_at(d, level);
  const auto between = [&](int along, double at)
  {
    const auto &planes = lattice.planes[along];
    return static_cast<int>(std::upper_bound(planes.begin(), planes.end(), at) - planes.begin()) - 1;
  };
  Index3 below;
  below[(d + 1) % 3] = between((d + 1) % 3, x[0]);
  below[(d + 2) % 3] = between((d + 2) % 3, x[1]);
  Index3 above       = below;
  below[d]           = plane - 1;
  above[d]           = plane;
  if ((lattice.at(below) >= 0) == (lattice.at(above) >= 0))
    return {level, level};
  const int step = lattice.at(above) >= 0 ? 1 : -1;
  int       end  = plane;
  for (Index3 &at = step > 0 ? above : below; lattice.at(at) >= 0; at[d] += step)
    end += step;
  return std::minmax(lattice.planes[d][plane], lattice.planes[d][end]);
}

} // namespace

bool touch(const std::vector<Side> &a, const std::vector<Side> &b)
{
  constexpr double near = 0.1; // of a side: cells between would be ten times as long as wide
  for (const Side &p : a)
    for (const Side &q : b)
      if (const double room = near * std::min(std::hypot(p[1][0] - p[0][0], p[1][1] - p[0][1]),
                                              std::hypot(q[1][0] - q[0][0], q[1][1] - q[0][1]));
          crosses(p, q) || distance_to(p[0], q) < room || distance_to(q[0], p) < room)
        return true;
  return false;
}

double gap_between(const std::vector<Side> &a, const std::vector<Side> &b)
{
  double gap = 1e300;
  for (const Side &p : a)
    for (const Side &q : b)
      gap = std::min({gap, distance_to(p[0], q), distance_to(q[0], p)});
  return gap;
}

void add_footprints(PlateSolids &solids, const std::set<int> &contacts, double unit, double diagonal)
{
  const bool any = std::any_of(solids.faces.begin(), solids.faces.end(),
                               [&](const PlateFace &face) { return contacts.count(face.tag) > 0; });
  if (!any)
    return;
  const BrickLattice lattice = brick_lattice(solids, diagonal);
  for (const PlateFace &face : solids.faces)
  {
    if (contacts.count(face.tag) == 0)
      continue;
    if (const FaceLoop *loop = outer_loop(face))
    {
      const Outline outline  = of_equal_area(outline_of(loop->edges, {solids.axes, face.direction, unit}));
      const auto [from, to]  = through_plate(lattice, face.direction, face.level, outline.sides.front()[0]);
      const auto overlapping = [&, from = from, to = to](const PlateHole &hole) {
        return hole.direction == face.direction && hole.from < to && from < hole.to && touch(hole.sides, outline.sides);
      };
      if (from < to && std::none_of(solids.holes.begin(), solids.holes.end(), overlapping))
        solids.holes.push_back({face.direction, from, to, outline.sides, std::vector<int>(outline.sides.size(), 0),
                                outline.min, outline.max, 0, true});
    }
  }
}

} // namespace gestell::fem
