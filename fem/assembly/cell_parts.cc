#include "fem/assembly/cell_parts.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/sparse_sum.h"

#include <metis.h>

#include <algorithm>
#include <map>
#include <memory>
#include <new>
#include <numeric>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/// Sets of cells that stay together.
class CellGroups
{
public:
  explicit CellGroups(int n_cells) : leader_(n_cells) { std::iota(leader_.begin(), leader_.end(), 0); }

  int leader(int cell)
  {
    while (leader_[cell] != cell)
      cell = leader_[cell] = leader_[leader_[cell]];
    return cell;
  }
  void unite(int a, int b) { leader_[leader(a)] = leader(b); }

  /// Number of the group of every cell, 0, 1, ...
  std::vector<idx_t> numbers()
  {
    std::vector<idx_t> number(leader_.size(), -1), result(leader_.size());
    idx_t              count = 0;
    for (std::size_t cell = 0; cell < leader_.size(); ++cell)
    {
      idx_t &own = number[leader(int(cell))];
      if (own < 0)
        own = count++;
      result[cell] = own;
    }
    return result;
  }

private:
  std::vector<int> leader_;
};

/// Cells that the displacement of a common node moves, by ties of an averaged surface, are one group.  The inner
/// coordinates of such surfaces and the nodes of interfaces and masses may belong to several parts: they are few, and
/// move cells far apart.
std::vector<idx_t> groups_of_cells(const QuadraticMesh &mesh, const AffineConstraints &affine)
{
  CellGroups       groups(mesh.n_cells());
  std::vector<int> moved(affine.n_coordinates(), -1); // a cell with a tied node that the coordinate moves
  std::vector<int> first(mesh.n_nodes(), -1);         // cell of a tied node
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (int a = 0; a < mesh.n_nodes_of(cell); ++a)
    {
      const int node = mesh.nodes(cell)[a];
      if (first[node] >= 0)
      {
        groups.unite(cell, first[node]);
        continue;
      }
      for (int i = 3 * node; i < 3 * node + 3; ++i)
        if (affine.coordinate(i) < 0)
          for (const auto &[coordinate, weight] : affine.row(i))
          {
            if (coordinate >= affine.n_free())
              continue;
            first[node] = cell;
            if (moved[coordinate] >= 0)
              groups.unite(cell, moved[coordinate]);
            moved[coordinate] = cell;
          }
    }
  return groups.numbers();
}

void require_metis(int status)
{
  if (status != METIS_OK)
    throw std::bad_alloc();
}

struct Graph
{
  std::vector<idx_t> begin{0}, to, edge_weight, weight;
};

/// Groups as vertices, weighted by their cells; edges weighted by the common faces.
Graph graph_of(const QuadraticMesh &mesh, const std::vector<idx_t> &group)
{
  std::vector<idx_t> begin{0}, corners;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    corners.insert(corners.end(), mesh.nodes(cell), mesh.nodes(cell) + cell_shape(mesh.kind(cell)).n_corners);
    begin.push_back(idx_t(corners.size()));
  }
  idx_t  n_cells = mesh.n_cells(), n_nodes = mesh.n_nodes(), of_a_face = 3, from_zero = 0;
  idx_t *first = nullptr, *neighbour = nullptr;
  require_metis(
      METIS_MeshToDual(&n_cells, &n_nodes, begin.data(), corners.data(), &of_a_face, &from_zero, &first, &neighbour));
  const auto                                      release = [](idx_t *p) { METIS_Free(p); };
  const std::unique_ptr<idx_t, decltype(release)> keep_first(first, release), keep_neighbour(neighbour, release);

  const idx_t                   n_groups = *std::max_element(group.begin(), group.end()) + 1;
  std::vector<std::vector<int>> cells(n_groups);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    cells[group[cell]].push_back(cell);
  Graph graph;
  for (idx_t g = 0; g < n_groups; ++g)
  {
    std::map<idx_t, idx_t> faces;
    for (const int cell : cells[g])
      for (idx_t k = first[cell]; k < first[cell + 1]; ++k)
        if (const idx_t other = group[neighbour[k]]; other != g)
          ++faces[other];
    for (const auto &[other, count] : faces)
    {
      graph.to.push_back(other);
      graph.edge_weight.push_back(count);
    }
    graph.begin.push_back(idx_t(graph.to.size()));
    graph.weight.push_back(idx_t(cells[g].size()));
  }
  return graph;
}

/// Part of every vertex.
std::vector<idx_t> divided(Graph &graph, idx_t n_parts)
{
  idx_t              n = idx_t(graph.weight.size()), n_constraints = 1, cut = 0;
  std::vector<idx_t> part(n);
  idx_t              options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED]  = 1; // the same parts in every run
  options[METIS_OPTION_NCUTS] = 4; // of which the best is taken
  constexpr idx_t few         = 8; // parts, for which bisection cuts fewer faces
  require_metis((n_parts > few ? METIS_PartGraphKway : METIS_PartGraphRecursive)(
      &n, &n_constraints, graph.begin.data(), graph.to.data(), graph.weight.data(), nullptr, graph.edge_weight.data(),
      &n_parts, nullptr, nullptr, options, &cut, part.data()));
  return part;
}

} // namespace

CellParts::CellParts(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                     int n_parts, const std::string &place)
    : mesh_(mesh), materials_(materials), affine_(affine), cells_(n_parts)
{
  const std::vector<idx_t> group    = groups_of_cells(mesh, affine);
  Graph                    graph    = graph_of(mesh, group);
  const auto               n_groups = graph.weight.size();
  std::vector<idx_t>       part(n_groups, 0);
  if (n_parts > 1 && n_groups >= std::size_t(n_parts))
    part = divided(graph, n_parts);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    cells_[part[group[cell]]].push_back(cell);
  if (std::any_of(cells_.begin(), cells_.end(), [](const auto &cells) { return cells.empty(); }))
    throw std::invalid_argument(place + ": parts = " + std::to_string(n_parts) + ", but the frame has only " +
                                std::to_string(mesh.n_cells()) + " cells, up to " +
                                std::to_string(*std::max_element(graph.weight.begin(), graph.weight.end())) +
                                " of which stay together at an averaged surface; use fewer parts, or parts = \"auto\"");
}

std::vector<int> CellParts::coordinates(int part) const
{
  std::vector<char> node_is_in(mesh_.n_nodes(), 0), moves(affine_.n_coordinates(), 0);
  for (const int cell : cells_[part])
    for (int a = 0; a < mesh_.n_nodes_of(cell); ++a)
      node_is_in[mesh_.nodes(cell)[a]] = 1;
  for (int i = 0; i < affine_.n_displacements(); ++i)
    if (node_is_in[i / 3])
      for (const auto &[coordinate, weight] : affine_.row(i))
        moves[coordinate] = 1;
  std::vector<int> result;
  for (int i = 0; i < affine_.n_coordinates(); ++i)
    if (moves[i])
      result.push_back(i);
  return result;
}

PartMatrices CellParts::matrices(int part) const
{
  Extent     extent{cells_[part], coordinates(part)};
  MatrixSums sums = assemble(mesh_, materials_, affine_, extent);
  if (const SparseMatrix K = geometric(part); K.nonZeros() > 0)
    add(sums.C, K);
  return {std::move(sums.C), std::move(sums.M), std::move(extent.coordinates)};
}

SparseMatrix CellParts::geometric(int part) const
{
  return materials_.u0.size() > 0 ? assemble_geometric(mesh_, materials_, affine_, {cells_[part], coordinates(part)})
                                  : SparseMatrix();
}

} // namespace gestell::fem
