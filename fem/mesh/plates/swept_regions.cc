#include "fem/mesh/plates/swept_regions.h"

#include "fem/values/message_text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gestell::fem
{

namespace
{

constexpr std::array<double, 4> margins = {0.75, 0.5, 0.3, 0.15}; // about a hole, of its half width
constexpr double                same    = 1e-7;                   // [m] rounding

/// A box about holes, along their axis and in the plane of the plate.
struct Box
{
  int              direction;
  double           from, to;
  Point2           min, max;
  std::vector<int> holes;
};

bool overlap(const Box &a, const Box &b)
{
  if (a.direction != b.direction || a.from > b.to + same || b.from > a.to + same)
    return false;
  for (int k = 0; k < 2; ++k)
    if (a.min[k] > b.max[k] + same || b.min[k] > a.max[k] + same)
      return false;
  return true;
}

void unite(Box &box, const Box &other)
{
  box.from = std::min(box.from, other.from);
  box.to   = std::max(box.to, other.to);
  for (int k = 0; k < 2; ++k)
  {
    box.min[k] = std::min(box.min[k], other.min[k]);
    box.max[k] = std::max(box.max[k], other.max[k]);
  }
  box.holes.insert(box.holes.end(), other.holes.begin(), other.holes.end());
}

/// Boxes that overlap become one.
std::vector<Box> united(const std::vector<Box> &boxes)
{
  std::vector<Box> result;
  for (Box box : boxes)
  {
    for (std::size_t i = 0; i < result.size();)
      if (overlap(box, result[i]))
      {
        unite(box, result[i]);
        result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
        i = 0;
      }
      else
        ++i;
    result.push_back(std::move(box));
  }
  return result;
}

/// Whether the plate fills the box, except for holes, and nothing adjoins it there.
bool is_plate(const BrickLattice &lattice, const Box &box)
{
  const int d = box.direction;
  for (std::size_t brick = 0; brick < lattice.size(); ++brick)
  {
    const Index3 i      = lattice.place(brick);
    const auto   within = [&](int direction, double from, double to)
    {
      return lattice.planes[direction][i[direction] + 1] > from + same &&
             lattice.planes[direction][i[direction]] < to - same;
    };
    if (!within((d + 1) % 3, box.min[0], box.max[0]) || !within((d + 2) % 3, box.min[1], box.max[1]))
      continue;
    const bool inside = within(d, box.from, box.to);
    const bool nearby =
        std::abs(lattice.planes[d][i[d] + 1] - box.from) < same || std::abs(lattice.planes[d][i[d]] - box.to) < same;
    if ((inside && lattice.solid[brick] < 0) || (nearby && lattice.solid[brick] >= 0))
      return false;
  }
  for (int k = 0; k < 2; ++k)
  {
    const std::vector<double> &planes = lattice.planes[(d + 1 + k) % 3];
    if (box.min[k] < planes.front() - same || box.max[k] > planes.back() + same)
      return false;
  }
  return true;
}

/// The box with a margin, whose sides go to planes that are near.
Box widened(const Box &box, double margin, const BrickLattice &lattice)
{
  Box          wide = box;
  const double half = 0.5 * std::min(box.max[0] - box.min[0], box.max[1] - box.min[1]), aside = margin * half;
  for (int k = 0; k < 2; ++k)
  {
    wide.min[k] -= aside;
    wide.max[k] += aside;
    for (const double plane : lattice.planes[(box.direction + 1 + k) % 3])
    {
      constexpr double near = 0.6; // of the margin: a plane that close bounds the region
      if (std::abs(plane - wide.min[k]) < near * aside && plane < box.min[k] - margins.back() * half)
        wide.min[k] = plane;
      if (std::abs(plane - wide.max[k]) < near * aside && plane > box.max[k] + margins.back() * half)
        wide.max[k] = plane;
    }
  }
  return wide;
}

/// The box with the widest margin that the plate fills; none if it fills none.
std::optional<Box> fitting(const Box &box, const BrickLattice &lattice)
{
  for (const double margin : margins)
    if (Box wide = widened(box, margin, lattice); is_plate(lattice, wide))
      return wide;
  return std::nullopt;
}

[[noreturn]] void refuse(const PlateSolids &solids, const Box &box)
{
  const int     d  = box.direction;
  const Vector3 at = 0.5 * (box.from + box.to) * solids.axes[d] +
                     0.5 * (box.min[0] + box.max[0]) * solids.axes[(d + 1) % 3] +
                     0.5 * (box.min[1] + box.max[1]) * solids.axes[(d + 2) % 3];
  throw NotSwept("the hole at " + text(at) +
                     " m has no plain plate around it (an edge, a step or another wall is next to it)",
                 solids.holes[box.holes.front()].solid);
}

/// @param holes  into solids.holes
std::vector<Box> boxes_around(const PlateSolids &solids, const std::vector<int> &holes)
{
  std::vector<Box> boxes;
  for (const int h : holes)
  {
    const PlateHole &hole = solids.holes[h];
    boxes.push_back({hole.direction, hole.from, hole.to, hole.min, hole.max, {h}});
  }
  return united(boxes);
}

std::vector<Box> boxes_of(const PlateSolids &solids, const BrickLattice &lattice)
{
  std::vector<int> holes;
  for (std::size_t h = 0; h < solids.holes.size(); ++h)
    holes.push_back(static_cast<int>(h));
  const auto drop_footprints = [&](const Box &box)
  {
    const std::size_t before = holes.size();
    for (const int h : box.holes)
      if (solids.holes[h].filled)
        holes.erase(std::remove(holes.begin(), holes.end(), h), holes.end());
    return holes.size() < before;
  };
  while (true)
  {
    bool             again = false;
    std::vector<Box> wide;
    for (const Box &box : boxes_around(solids, holes))
      if (const std::optional<Box> fits = fitting(box, lattice))
        wide.push_back(*fits);
      else if (drop_footprints(box))
        again = true;
      else
        refuse(solids, box);
    wide = united(wide);
    for (const Box &box : wide)
      if (!again && !is_plate(lattice, box))
      {
        if (!drop_footprints(box))
          throw NotSwept("holes close to each other, one at height " + text(box.from) +
                             " m, have no plain plate around them",
                         solids.holes[box.holes.front()].solid);
        again = true;
      }
    if (!again)
      return wide;
  }
}

} // namespace

BrickLattice lattice_with_regions(const PlateSolids &solids, double diagonal)
{
  if (solids.holes.empty())
    return brick_lattice(solids, diagonal);
  const std::vector<Box>             boxes = boxes_of(solids, brick_lattice(solids, diagonal));
  std::array<std::vector<double>, 3> more;
  for (const Box &box : boxes)
    for (int k = 0; k < 2; ++k)
      for (const double level : {box.min[k], box.max[k]})
        more[(box.direction + 1 + k) % 3].push_back(level);
  BrickLattice lattice = brick_lattice(solids, diagonal, more);
  for (const Box &box : boxes)
  {
    const int   d = box.direction, a = (d + 1) % 3, b = (d + 2) % 3;
    SweptRegion region{d, {}, {}, box.holes};
    region.from[d] = lattice.plane_at(d, box.from);
    region.to[d]   = lattice.plane_at(d, box.to);
    region.from[a] = lattice.plane_at(a, box.min[0]);
    region.to[a]   = lattice.plane_at(a, box.max[0]);
    region.from[b] = lattice.plane_at(b, box.min[1]);
    region.to[b]   = lattice.plane_at(b, box.max[1]);
    for (int k = region.from[2]; k < region.to[2]; ++k)
      for (int j = region.from[1]; j < region.to[1]; ++j)
        for (int i = region.from[0]; i < region.to[0]; ++i)
          lattice.region[lattice.index({i, j, k})] = static_cast<int>(lattice.regions.size());
    lattice.regions.push_back(std::move(region));
  }
  return lattice;
}

} // namespace gestell::fem
