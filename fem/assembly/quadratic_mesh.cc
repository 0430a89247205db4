#include "fem/assembly/quadratic_mesh.h"

#include "fem/parallel/petsc_session.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/tria.h>

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace gestell::fem
{

namespace
{

using EdgeNodes = std::unordered_map<std::uint64_t, int>; // node in the middle of an edge between two points

std::uint64_t edge_key(unsigned int a, unsigned int b)
{
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

double signed_volume(const Mesh &mesh, const std::array<int, 4> &cell)
{
  double e[3][3];
  for (int k = 0; k < 3; ++k)
    for (int d = 0; d < 3; ++d)
      e[k][d] = mesh.points[cell[k + 1]][d] - mesh.points[cell[0]][d];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6.;
}

void require_sound(const Mesh &mesh)
{
  if (mesh.cells.empty())
    throw std::invalid_argument("quadratic_mesh: the mesh has no cells; a solid volume is needed, not surfaces.");
  for (std::size_t i = 0; i < mesh.cells.size(); ++i)
    if (const double volume = signed_volume(mesh, mesh.cells[i]); !(volume > 0.))
    {
      std::ostringstream message;
      message << "quadratic_mesh: tetrahedron " << i << " has the volume " << volume
              << " m^3, but a positive one is needed; mesh again with another size.";
      throw std::invalid_argument(message.str());
    }
}

dealii::Triangulation<3> triangulation(const Mesh &mesh)
{
  std::vector<dealii::Point<3>> points;
  points.reserve(mesh.points.size());
  for (const Point3 &p : mesh.points)
    points.emplace_back(p[0], p[1], p[2]);

  std::vector<dealii::CellData<3>> cells(mesh.cells.size(), dealii::CellData<3>(4));
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int k = 0; k < 4; ++k)
      cells[i].vertices[k] = mesh.cells[i][k];

  dealii::Triangulation<3> result;
  result.create_triangulation(points, cells, dealii::SubCellData());
  return result;
}

/// The two corners an edge node of the reference tetrahedron lies between, read off its support points.
std::array<std::array<int, 2>, 6> edge_corners(const dealii::FiniteElement<3> &element)
{
  const auto                       &support = element.get_unit_support_points();
  std::array<std::array<int, 2>, 6> result{};
  for (int e = 0; e < 6; ++e)
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if (support[4 + e].distance(0.5 * (support[a] + support[b])) < 1e-12)
          result[e] = {a, b};
  return result;
}

std::array<int, 6> triangle_nodes(const std::array<int, 3> &corners, const std::vector<int> &node_of,
                                  const EdgeNodes &edge_nodes)
{
  std::array<int, 6> nodes{};
  for (int k = 0; k < 3; ++k)
  {
    const auto edge = edge_nodes.find(edge_key(corners[k], corners[(k + 1) % 3]));
    if (edge == edge_nodes.end())
      throw std::invalid_argument("quadratic_mesh: a triangle of the skin is no face of a tetrahedron; surface and "
                                  "volume mesh must share their points.");
    nodes[k]     = node_of[corners[k]];
    nodes[3 + k] = edge->second;
  }
  return nodes;
}

} // namespace

QuadraticMesh quadratic_mesh(const Mesh &mesh)
{
  require_sound(mesh);
  petsc_session(); // deal.II asks MPI for its rank

  const dealii::Triangulation<3> cells_of_mesh = triangulation(mesh);
  const dealii::FE_SimplexP<3>   element(2);
  dealii::DoFHandler<3>          nodes(cells_of_mesh);
  nodes.distribute_dofs(element);
  const auto corners_of_edge = edge_corners(element);

  QuadraticMesh result;
  result.points.resize(nodes.n_dofs());
  result.cells.resize(mesh.cells.size());
  result.node_of.assign(mesh.points.size(), -1);

  EdgeNodes                                    edge_nodes;
  std::vector<dealii::types::global_dof_index> numbers(10);
  for (const auto &cell : nodes.active_cell_iterators())
  {
    cell->get_dof_indices(numbers);
    std::copy(numbers.begin(), numbers.end(), result.cells[cell->index()].begin());
    for (int k = 0; k < 4; ++k)
    {
      const int point           = cell->vertex_index(k);
      result.points[numbers[k]] = mesh.points[point];
      result.node_of[point]     = numbers[k];
    }
    for (int e = 0; e < 6; ++e)
    {
      const auto [a, b] = corners_of_edge[e];
      edge_nodes.emplace(edge_key(cell->vertex_index(a), cell->vertex_index(b)), numbers[4 + e]);
      for (int d = 0; d < 3; ++d)
        result.points[numbers[4 + e]][d] = 0.5 * (cell->vertex(a)[d] + cell->vertex(b)[d]);
      if (mesh.middles.empty())
        continue;
      const int  i = cell->vertex_index(a), j = cell->vertex_index(b);
      const auto middle = mesh.middles.find({std::min(i, j), std::max(i, j)});
      if (middle == mesh.middles.end())
        continue;
      result.points[numbers[4 + e]] = middle->second;
      result.curved.resize(mesh.cells.size(), 0);
      result.curved[cell->index()] = 1;
    }
  }

  result.skin.reserve(mesh.skin.size());
  for (const std::array<int, 3> &corners : mesh.skin)
    result.skin.push_back(triangle_nodes(corners, result.node_of, edge_nodes));
  return result;
}

} // namespace gestell::fem
