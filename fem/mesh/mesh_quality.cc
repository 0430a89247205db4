#include "fem/mesh/mesh_quality.h"

#include "fem/values/vector3.h"

#include <algorithm>
#include <limits>

namespace gestell::fem
{

namespace
{

/// Cells around each point.
std::vector<std::vector<int>> stars_of(const Mesh &mesh)
{
  std::vector<std::vector<int>> stars(mesh.points.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int point : mesh.cells[c])
      stars[point].push_back(static_cast<int>(c));
  return stars;
}

double worst_quality(const Mesh &mesh, const std::vector<int> &star)
{
  double worst = std::numeric_limits<double>::infinity();
  for (const int cell : star)
    worst = std::min(worst, quality(mesh, mesh.cells[cell]));
  return worst;
}

double shortest_edge(const Mesh &mesh, int point, const std::vector<int> &star)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const int cell : star)
    for (const int other : mesh.cells[cell])
      if (other != point)
        shortest = std::min(shortest, norm(mesh.points[other] - mesh.points[point]));
  return shortest;
}

/// Moves one point uphill in the worst quality of its star.
void climb(Mesh &mesh, int point, const Freedom &freedom, const std::vector<int> &star)
{
  const double     edge       = shortest_edge(mesh, point, star);
  double           best       = worst_quality(mesh, star);
  constexpr double first_step = 0.2;   // of the shortest edge at the point: cells stay upright
  constexpr double last_step  = 0.005; // of the same edge: what is moved less changes no quality
  for (double step = first_step; step > last_step;)
  {
    const Point3 from = mesh.points[point];
    Point3       to   = from;
    for (const Vector3 &direction : freedom)
      for (const double sign : {1., -1.})
      {
        mesh.points[point]          = from + (sign * step * edge) * direction;
        const double     here       = worst_quality(mesh, star);
        constexpr double least_gain = 1e-6; // of a quality between 0 and 1: above its rounding
        if (here > best + least_gain)
        {
          best = here;
          to   = mesh.points[point];
        }
      }
    mesh.points[point] = to;
    if (to == from)
      step *= 0.5;
  }
}

} // namespace

double six_volumes(const Mesh &mesh, const std::array<int, 4> &cell)
{
  const Vector3 &p = mesh.points[cell[0]];
  return dot(cross(mesh.points[cell[1]] - p, mesh.points[cell[2]] - p), mesh.points[cell[3]] - p);
}

double quality(const Mesh &mesh, const std::array<int, 4> &cell)
{
  double squares = 0.;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
    {
      const Vector3 edge = mesh.points[cell[i]] - mesh.points[cell[j]];
      squares += dot(edge, edge);
    }
  return 12. * std::pow(std::max(0., six_volumes(mesh, cell)) / 2., 2. / 3.) / squares;
}

void improve_quality(Mesh &mesh, const std::vector<Freedom> &freedom, double wanted)
{
  const std::vector<std::vector<int>> stars = stars_of(mesh);
  constexpr int sweeps = 4; // over all bad cells; more than three changed nothing on the frames tried
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const auto &cell : mesh.cells)
      if (quality(mesh, cell) < wanted)
        for (const int point : cell)
          climb(mesh, point, freedom[point], stars[point]);
}

} // namespace gestell::fem
