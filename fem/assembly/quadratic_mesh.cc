#include "fem/assembly/quadratic_mesh.h"

#include "fem/assembly/finite_elements.h"
#include "fem/assembly/reference_cell.h"
#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mesh_quality.h"
#include "fem/parallel/petsc_session.h"
#include "fem/values/message_text.h"

#include <deal.II/dofs/dof_handler.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace gestell::fem
{

namespace
{

void require_sound(const Mesh &mesh)
{
  if (mesh.n_cells() == 0)
    throw std::invalid_argument("quadratic_mesh: the mesh has no cells; a solid volume is needed, not surfaces.");
  for (std::size_t i = 0; i < mesh.cells.size(); ++i)
    if (const double volume = six_volumes(mesh, mesh.cells[i]) / 6.; !(volume > 0.))
      throw std::invalid_argument("quadratic_mesh: tetrahedron " + std::to_string(i) + " has a volume of " +
                                  text(volume) + " m^3; it must be positive: mesh again with another size.");
  for (int i = static_cast<int>(mesh.cells.size()); i < mesh.n_cells(); ++i)
    if (const double q = corner_quality(mesh, i); !(q > 0.))
      throw std::invalid_argument(
          "quadratic_mesh: " + std::string(mesh.kind(i) == CellKind::prism ? "prism" : "hexahedron") + ", cell " +
          std::to_string(i) + ", folds: the determinant at a corner is " + text(q) +
          " times the edges there and must be positive; mesh again, or order its corners as gmsh does.");
}

std::shared_ptr<const Grid> grid_of(const Mesh &mesh)
{
  std::vector<dealii::Point<3>> points;
  points.reserve(mesh.points.size());
  for (const Point3 &p : mesh.points)
    points.emplace_back(p[0], p[1], p[2]);

  std::vector<dealii::CellData<3>> cells;
  cells.reserve(mesh.n_cells());
  for (int i = 0; i < mesh.n_cells(); ++i)
  {
    const std::vector<int> &node_of_corner = reference_cell(mesh.kind(i)).node_of_corner;
    cells.emplace_back(static_cast<unsigned int>(node_of_corner.size()));
    for (std::size_t k = 0; k < node_of_corner.size(); ++k)
      cells.back().vertices[node_of_corner[k]] = mesh.corners(i)[k];
  }
  auto grid = std::make_shared<Grid>();
  grid->cells.create_triangulation(points, cells, dealii::SubCellData());
  return grid;
}

int *nodes_of(QuadraticMesh &mesh, int cell)
{
  return const_cast<int *>(mesh.nodes(cell));
}

int number_by_deal_ii(const Grid &grid, const Mesh &mesh, QuadraticMesh &result)
{
  dealii::DoFHandler<3> handler(grid.cells);
  handler.distribute_dofs(finite_element(mesh.kind(0)));
  std::vector<dealii::types::global_dof_index> numbers;
  for (const auto &cell : handler.active_cell_iterators())
  {
    numbers.resize(result.n_nodes_of(cell->index()));
    cell->get_dof_indices(numbers);
    std::copy(numbers.begin(), numbers.end(), nodes_of(result, cell->index()));
  }
  return static_cast<int>(handler.n_dofs());
}

/// By the corners of the mesh between which a node is.  With cells of several kinds the DoFHandler of deal.II 9.4 gives
/// numbers of other nodes to some of them, on meshes whose cells are in no order.
int number_by_corners(const Mesh &mesh, QuadraticMesh &result)
{
  std::map<std::vector<int>, int> number;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const ReferenceCell &reference = reference_cell(mesh.kind(cell));
    std::vector<int>     corner_of(reference.n_corners); // of the mesh, by node
    for (int k = 0; k < reference.n_corners; ++k)
      corner_of[reference.node_of_corner[k]] = mesh.corners(cell)[k];
    for (int a = 0; a < reference.n_nodes; ++a)
    {
      std::vector<int> corners;
      for (const int node : reference.between[a])
        corners.push_back(corner_of[node]);
      std::sort(corners.begin(), corners.end());
      nodes_of(result, cell)[a] = number.try_emplace(corners, static_cast<int>(number.size())).first->second;
    }
  }
  return static_cast<int>(number.size());
}

void number_nodes(const Grid &grid, const Mesh &mesh, QuadraticMesh &result)
{
  result.cells.resize(mesh.cells.size());
  result.hexahedra.resize(mesh.hexahedra.size());
  result.prisms.resize(mesh.prisms.size());
  const std::size_t of_one_kind = std::max({mesh.cells.size(), mesh.hexahedra.size(), mesh.prisms.size()});
  const bool        is_mixed    = mesh.n_cells() > static_cast<int>(of_one_kind);
  result.points.resize(is_mixed ? number_by_corners(mesh, result) : number_by_deal_ii(grid, mesh, result));
}

/// Places nodes in the middle of their corners.
void place_nodes(const Mesh &mesh, QuadraticMesh &result)
{
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const ReferenceCell &reference = reference_cell(mesh.kind(cell));
    const int           *nodes     = result.nodes(cell);
    for (std::size_t k = 0; k < reference.node_of_corner.size(); ++k)
    {
      const int node                        = nodes[reference.node_of_corner[k]];
      result.points[node]                   = mesh.points[mesh.corners(cell)[k]];
      result.node_of[mesh.corners(cell)[k]] = node;
    }
    for (int a = reference.n_corners; a < reference.n_nodes; ++a)
      for (int d = 0; d < 3; ++d)
      {
        double sum = 0.;
        for (const int corner : reference.between[a])
          sum += result.points[nodes[corner]][d];
        result.points[nodes[a]][d] = sum / static_cast<double>(reference.between[a].size());
      }
  }
}

/// Moves the middles of curved edges of tetrahedra.
void bend_edges(const Mesh &mesh, QuadraticMesh &result)
{
  const ReferenceCell &reference = reference_cell(CellKind::tetrahedron);
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int a = reference.n_corners; a < reference.n_nodes; ++a)
    {
      const auto [i, j] =
          std::minmax(mesh.cells[cell][reference.between[a][0]], mesh.cells[cell][reference.between[a][1]]);
      const auto middle = mesh.middles.find({i, j});
      if (middle == mesh.middles.end())
        continue;
      result.points[result.cells[cell][a]] = middle->second;
      result.curved.resize(mesh.cells.size(), 0);
      result.curved[cell] = 1;
    }
}

/// Nodes of the outer faces, found by the corners between which they lie: two per edge, or of a diagonal.
class OuterNodes
{
public:
  OuterNodes(const Grid &grid, const QuadraticMesh &mesh) : mesh_(mesh)
  {
    for (const auto &cell : grid.cells.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face))
          add(cell->index(), reference_cell(mesh.kind(cell->index())).faces[face]);
  }

  std::array<int, 6> triangle(const std::array<int, 3> &corners) const
  {
    const auto [a, b, c] = at(corners);
    return {a, b, c, amid(a, b), amid(b, c), amid(c, a)};
  }
  std::array<int, 9> quadrilateral(const std::array<int, 4> &corners) const
  {
    const auto [a, b, c, d] = at(corners);
    const int centre        = amid(a, c);
    if (centre != amid(b, d))
      refuse();
    return {a, b, d, c, amid(a, d), amid(b, c), amid(a, b), amid(d, c), centre};
  }

private:
  static std::uint64_t key(int a, int b)
  {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
  }
  [[noreturn]] static void refuse()
  {
    throw std::invalid_argument(
        "quadratic_mesh: an outer face is not a face of any cell; surface and volume mesh must share "
        "their points.");
  }

  /// @param corners of a face, local; of a quadrilateral in deal.II's order.
  void add(int cell, const std::vector<int> &corners)
  {
    const ReferenceCell &reference = reference_cell(mesh_.kind(cell));
    const int           *nodes     = mesh_.nodes(cell);
    const auto           is_in     = [&](int k) { return std::count(corners.begin(), corners.end(), k) > 0; };
    for (int a = reference.n_corners; a < reference.n_nodes; ++a)
    {
      const std::vector<int> &amid = reference.between[a];
      if (!std::all_of(amid.begin(), amid.end(), is_in))
        continue;
      if (amid.size() == 2)
        middles_.emplace(key(nodes[amid[0]], nodes[amid[1]]), nodes[a]);
      else
        for (const auto &[i, j] : {std::pair(0, 3), std::pair(1, 2)})
          middles_.emplace(key(nodes[corners[i]], nodes[corners[j]]), nodes[a]);
    }
  }

  template <std::size_t n>
  std::array<int, n> at(std::array<int, n> points) const
  {
    for (int &point : points)
      point = mesh_.node_of[point];
    return points;
  }
  int amid(int a, int b) const
  {
    const auto found = middles_.find(key(a, b));
    if (found == middles_.end())
      refuse();
    return found->second;
  }

  const QuadraticMesh                   &mesh_;
  std::unordered_map<std::uint64_t, int> middles_;
};

void number_skin(const Mesh &mesh, const OuterNodes &outer, QuadraticMesh &result)
{
  result.skin.reserve(mesh.skin.size());
  for (const auto &corners : mesh.skin_quads)
  {
    result.skin_quads.push_back(outer.quadrilateral(corners));
    const auto &[a, b, d, c, ad, bc, ab, dc, centre] = result.skin_quads.back();
    result.skin.push_back({a, b, c, ab, bc, centre});
    result.skin.push_back({a, c, d, centre, dc, ad});
  }
  for (std::size_t k = 2 * mesh.skin_quads.size(); k < mesh.skin.size(); ++k)
    result.skin.push_back(outer.triangle(mesh.skin[k]));
  for (const auto &[faces, cells, solids] : mesh.ties)
  {
    QuadraticTie tie{{}, {}, cells, solids};
    for (const auto &[a, b, c, d] : faces)
      if (d < 0)
        tie.triangles.push_back(outer.triangle({a, b, c}));
      else
        tie.quads.push_back(outer.quadrilateral({a, b, c, d}));
    result.ties.push_back(std::move(tie));
  }
}

} // namespace

QuadraticMesh quadratic_mesh(const Mesh &mesh)
{
  require_sound(mesh);
  petsc_session(); // deal.II requests its rank from MPI

  QuadraticMesh result;
  result.grid = grid_of(mesh);
  result.node_of.assign(mesh.points.size(), -1);
  number_nodes(*result.grid, mesh, result);
  place_nodes(mesh, result);
  if (!mesh.middles.empty())
    bend_edges(mesh, result);
  number_skin(mesh, OuterNodes(*result.grid, result), result);
  return result;
}

} // namespace gestell::fem
