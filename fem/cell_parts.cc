#include "fem/cell_parts.h"

#include <metis.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace gestell::fem
{

static_assert(std::is_same<idx_t, int>::value, "METIS must be built with 32-bit indices");

std::vector<int> part_cells(const QuadraticMesh &mesh, int parts)
{
  std::vector<int> part_of_cell(mesh.n_cells(), 0);
  if (parts == 1)
    return part_of_cell;
  int              n_cells = mesh.n_cells(), n_nodes = mesh.n_nodes(), cut = 0;
  int              common = mesh.hexahedra.empty() ? 6 : 9; // nodes of a face
  std::vector<int> begin(1, 0), nodes, part_of_node(n_nodes);
  for (int cell = 0; cell < n_cells; ++cell)
  {
    nodes.insert(nodes.end(), mesh.nodes(cell), mesh.nodes(cell) + mesh.nodes_per_cell());
    begin.push_back(static_cast<int>(nodes.size()));
  }
  const int code = METIS_PartMeshDual(&n_cells, &n_nodes, begin.data(), nodes.data(), nullptr, nullptr, &common, &parts,
                                      nullptr, nullptr, &cut, part_of_cell.data(), part_of_node.data());
  if (code == METIS_ERROR_MEMORY)
    throw std::bad_alloc();
  if (code != METIS_OK)
    throw std::runtime_error("part_cells: METIS failed with error " + std::to_string(code));
  return part_of_cell;
}

std::vector<int> part_nodes(const QuadraticMesh &mesh, const std::vector<int> &part_of_cell, int parts)
{
  std::vector<std::vector<int>> parts_of(mesh.n_nodes());
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (int k = 0; k < mesh.nodes_per_cell(); ++k)
    {
      std::vector<int> &of_node = parts_of[mesh.nodes(cell)[k]];
      if (std::find(of_node.begin(), of_node.end(), part_of_cell[cell]) == of_node.end())
        of_node.push_back(part_of_cell[cell]);
    }
  std::vector<int> count(parts, 0), part_of_node(mesh.n_nodes(), 0);
  for (int node = 0; node < mesh.n_nodes(); ++node)
  {
    if (!parts_of[node].empty())
      part_of_node[node] = *std::min_element(parts_of[node].begin(), parts_of[node].end(),
                                             [&](int a, int b) { return count[a] < count[b]; });
    ++count[part_of_node[node]];
  }
  return part_of_node;
}

namespace
{

template <std::size_t n>
void take_cells(const std::vector<std::array<int, n>> &cells, const std::vector<int> &chosen,
                const std::vector<int> &number, std::vector<std::array<int, n>> &taken)
{
  if (cells.empty())
    return;
  for (const int cell : chosen)
  {
    taken.push_back(cells[cell]);
    for (int &node : taken.back())
      node = number[node];
  }
}

} // namespace

FramePart frame_part(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics,
                     const std::vector<int> &part_of_cell, int part, std::vector<int> &nodes)
{
  FramePart         result;
  std::vector<int>  cells;
  std::vector<char> used(mesh.n_nodes(), 0);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    if (part_of_cell[cell] == part)
    {
      cells.push_back(cell);
      for (int k = 0; k < mesh.nodes_per_cell(); ++k)
        used[mesh.nodes(cell)[k]] = 1;
    }
  nodes.clear();
  std::vector<int> number(mesh.n_nodes(), -1);
  for (int node = 0; node < mesh.n_nodes(); ++node)
    if (used[node])
    {
      number[node] = static_cast<int>(nodes.size());
      nodes.push_back(node);
      result.mesh.points.push_back(mesh.points[node]);
    }
  take_cells(mesh.cells, cells, number, result.mesh.cells);
  take_cells(mesh.hexahedra, cells, number, result.mesh.hexahedra);
  result.materials.materials = materials.materials;
  for (const int cell : cells)
  {
    result.materials.of_cell.push_back(materials.of_cell[cell]);
    if (!mesh.curved.empty())
      result.mesh.curved.push_back(mesh.curved[cell]);
  }
  result.kinematics = kinematics.of_nodes(nodes);
  return result;
}

} // namespace gestell::fem
