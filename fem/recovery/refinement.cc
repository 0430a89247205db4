#include "fem/recovery/refinement.h"

#include "fem/mesh/mesh_size.h"
#include "fem/values/vector3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gestell::fem
{

namespace
{

constexpr double dimension = 3.; ///< of a solid: cells ~ 1 / h^3

constexpr std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The median of its edges: in a wall thinner than the elements that is an edge along the wall.
double cell_size(const QuadraticMesh &mesh, const std::array<int, 10> &cell)
{
  std::array<double, 6> length{};
  for (int e = 0; e < 6; ++e)
    length[e] = norm(mesh.points[cell[edges[e][1]]] - mesh.points[cell[edges[e][0]]]);
  std::sort(length.begin(), length.end());
  return length[3];
}

double cell_volume(const QuadraticMesh &mesh, const std::array<int, 10> &cell)
{
  const auto edge = [&](int k) { return mesh.points[cell[k]] - mesh.points[cell[0]]; };
  return std::abs(dot(edge(1), cross(edge(2), edge(3)))) / 6.;
}

/// Sizes of the cells for a multiplier lambda.
Eigen::VectorXd sizes_for(double lambda, const Eigen::VectorXd &h, const Eigen::VectorXd &shape,
                          const Refinement &refinement)
{
  Eigen::VectorXd  size(h.size());
  constexpr double most_grown = 1.5, most_shrunk = 1. / 3.; // of an element's size at once: estimates are rough
  for (Eigen::Index i = 0; i < h.size(); ++i)
    size[i] = std::clamp(h[i] * std::clamp(lambda * shape[i], most_shrunk, most_grown),
                         std::min(refinement.smallest, h[i]), refinement.largest);
  return size;
}

/// Number of new cells that replace the present ones.
double cells_for(const Eigen::VectorXd &size, const Eigen::VectorXd &h)
{
  return (h.array() / size.array()).pow(dimension).sum();
}

/// Lowers sizes until they grow by no more than size_growth along the edges of the mesh.
void limit_growth(const QuadraticMesh &mesh, std::vector<double> &size)
{
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const auto &cell : mesh.cells)
      for (const auto &[a, b] : edges)
      {
        const double far = size_growth * norm(mesh.points[cell[b]] - mesh.points[cell[a]]);
        double      &s = size[cell[a]], &t = size[cell[b]];
        if (s > (1. + 1e-6) * (t + far))
          s = t + far, changed = true;
        if (t > (1. + 1e-6) * (s + far))
          t = s + far, changed = true;
      }
  }
}

} // namespace

std::vector<SizePoint> refine(const MeshError &error, const Eigen::VectorXd &eta2, const Refinement &refinement)
{
  const QuadraticMesh &mesh = error.mesh();
  const auto           n    = static_cast<Eigen::Index>(mesh.cells.size());
  Eigen::VectorXd      h(n), shape(n);
  const double         least = 1e-6 * eta2.sum() / static_cast<double>(n); // limits the growth of cells without error
  for (Eigen::Index i = 0; i < n; ++i)
  {
    h[i]     = cell_size(mesh, mesh.cells[i]);
    shape[i] = std::pow(cell_volume(mesh, mesh.cells[i]) / (std::max(eta2[i], least) * std::pow(h[i], dimension)),
                        1. / (2. * order_of_refinement + dimension));
  }
  const double wanted = refinement.growth * static_cast<double>(n);
  double       low = std::log(1e-3 / shape.maxCoeff()), high = std::log(1e3 / shape.minCoeff());
  for (int i = 0; i < 60; ++i)
  {
    const double middle                                                                     = 0.5 * (low + high);
    (cells_for(sizes_for(std::exp(middle), h, shape, refinement), h) > wanted ? low : high) = middle;
  }
  const Eigen::VectorXd size = sizes_for(std::exp(low), h, shape, refinement);

  std::vector<double> at_node(mesh.n_nodes(), 0.), count(mesh.n_nodes(), 0.);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 4; ++k)
    {
      at_node[mesh.cells[i][k]] += std::log(size[i]);
      count[mesh.cells[i][k]] += 1.;
    }
  for (int i = 0; i < mesh.n_nodes(); ++i)
    at_node[i] = count[i] > 0. ? std::exp(at_node[i] / count[i]) : std::numeric_limits<double>::infinity();
  limit_growth(mesh, at_node);

  std::vector<SizePoint> points;
  for (int i = 0; i < mesh.n_nodes(); ++i)
    if (count[i] > 0.)
      points.push_back({mesh.points[i], at_node[i]});
  return points;
}

} // namespace gestell::fem
