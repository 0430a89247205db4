#include "fem/mesh/plates/brick_lattice.h"

#include <algorithm>
#include <cmath>

namespace gestell::fem
{

namespace
{

/// Heights that differ by rounding are one plane.
std::vector<double> planes_of(std::vector<double> levels, double tolerance)
{
  std::sort(levels.begin(), levels.end());
  std::vector<double> planes;
  for (const double level : levels)
    if (planes.empty() || level > planes.back() + tolerance)
      planes.push_back(level);
  return planes;
}

/// Fills the bricks of one solid: along a column its faces alternately enter and leave it.
class Filling
{
public:
  Filling(BrickLattice &lattice, const PlateSolids &solids) : lattice_(lattice), solids_(solids) {}

  void fill(int solid)
  {
    constexpr int     d = 2;
    std::vector<char> turns(lattice_.size() + std::size_t(lattice_.n(0)) * lattice_.n(1), 0);
    for (const int f : solids_.of_solid[solid])
      if (solids_.faces[f].direction == d)
        turn(solids_.faces[f], turns);
    for (int j = 0; j < lattice_.n(1); ++j)
      for (int i = 0; i < lattice_.n(0); ++i)
      {
        bool inside = false;
        for (int k = 0; k < lattice_.n(2); ++k)
        {
          const std::size_t brick = lattice_.index({i, j, k});
          inside                  = inside != (turns[brick] != 0);
          if (inside && lattice_.solid[brick] >= 0)
            throw NotSwept("two of its solids overlap");
          if (inside)
            lattice_.solid[brick] = solid;
        }
      }
  }

private:
  double middle(int direction, int i) const
  {
    return 0.5 * (lattice_.planes[direction][i] + lattice_.planes[direction][i + 1]);
  }

  void turn(const PlateFace &face, std::vector<char> &turns) const
  {
    const int k = lattice_.plane_at(2, face.level);
    for (int j = 0; j < lattice_.n(1); ++j)
      for (int i = 0; i < lattice_.n(0); ++i)
        if (const Point2 x = {middle(0, i), middle(1, j)}; x[0] > face.min[0] && x[0] < face.max[0] &&
                                                           x[1] > face.min[1] && x[1] < face.max[1] &&
                                                           PlateSolids::contains(face, x))
          turns[lattice_.index({i, j, k})] ^= 1;
  }

  BrickLattice      &lattice_;
  const PlateSolids &solids_;
};

} // namespace

int BrickLattice::plane_at(int direction, double level) const
{
  const std::vector<double> &all   = planes[direction];
  const auto                 above = std::lower_bound(all.begin(), all.end(), level);
  if (above == all.begin())
    return 0;
  if (above == all.end() || level - *(above - 1) < *above - level)
    return static_cast<int>(above - all.begin()) - 1;
  return static_cast<int>(above - all.begin());
}

BrickLattice brick_lattice(const PlateSolids &solids, double diagonal, const std::array<std::vector<double>, 3> &more)
{
  BrickLattice lattice;
  double       n = 1.;
  for (int d = 0; d < 3; ++d)
  {
    std::vector<double> levels = more[d];
    for (const PlateFace &face : solids.faces)
      if (face.direction == d)
        levels.push_back(face.level);
    constexpr double same_plane = 2e-6; // of the model: CAD programs agree on points to about 1e-7 of it
    lattice.planes[d]           = planes_of(levels, same_plane * diagonal);
    n *= std::max(0, lattice.n(d));
  }
  constexpr double most_bricks = 3e7; // 240 MB of marks
  if (n < 1. || n > most_bricks)
    throw NotSwept("the planes of its faces would divide it into " + text(n) + " bricks");
  lattice.solid.assign(std::size_t(lattice.n(0)) * lattice.n(1) * lattice.n(2), -1);
  lattice.region = lattice.solid;
  for (std::size_t solid = 0; solid < solids.of_solid.size(); ++solid)
    Filling(lattice, solids).fill(static_cast<int>(solid));
  return lattice;
}

} // namespace gestell::fem
