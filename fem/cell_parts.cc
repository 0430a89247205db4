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

namespace
{

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

} // namespace

FrameDivision divide(const QuadraticMesh &mesh, const Kinematics &kinematics, int parts)
{
  FrameDivision division{part_nodes(mesh, part_cells(mesh, parts), parts),
                         std::vector<int>(kinematics.n_coordinates(), -1)};
  for (int i = 0; i < kinematics.n_displacements(); ++i)
    for (const auto &[coordinate, weight] : kinematics.row(i))
      if (kinematics.coordinate(i) == coordinate || division.part_of_coordinate[coordinate] < 0)
        division.part_of_coordinate[coordinate] = division.part_of_node[i / 3];
  if (std::count(division.part_of_coordinate.begin(), division.part_of_coordinate.end(), -1) > 0)
    throw std::logic_error("divide: no node follows one of the coordinates");
  return division;
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

/// Nodes whose cells the part needs.
std::vector<char> nodes_needed(const Kinematics &kinematics, const FrameDivision &division, int part)
{
  std::vector<char> needed(division.part_of_node.size(), 0);
  for (std::size_t node = 0; node < needed.size(); ++node)
    needed[node] = division.part_of_node[node] == part;
  for (int i = 0; i < kinematics.n_displacements(); ++i)
    if (!needed[i / 3] && kinematics.coordinate(i) < 0)
      for (const auto &[coordinate, weight] : kinematics.row(i))
        if (division.part_of_coordinate[coordinate] == part)
          needed[i / 3] = 1;
  return needed;
}

} // namespace

FramePart frame_part(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics,
                     const FrameDivision &division, int part, std::vector<int> &nodes)
{
  const std::vector<char> needed = nodes_needed(kinematics, division, part);
  FramePart               result;
  std::vector<int>        cells;
  std::vector<char>       used(mesh.n_nodes(), 0);
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const int *const begin = mesh.nodes(cell), *const end = begin + mesh.nodes_per_cell();
    if (std::none_of(begin, end, [&](int node) { return needed[node]; }))
      continue;
    cells.push_back(cell);
    for (const int *node = begin; node != end; ++node)
      used[*node] = 1;
  }
  nodes.clear();
  std::vector<int> number(mesh.n_nodes(), -1);
  for (int node = 0; node < mesh.n_nodes(); ++node)
    if (used[node])
    {
      number[node] = static_cast<int>(nodes.size());
      if (division.part_of_node[node] == part)
        result.own_nodes.push_back(number[node]);
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
  for (std::size_t k = 0; k < result.kinematics.coordinates.size(); ++k)
    if (division.part_of_coordinate[result.kinematics.coordinates[k]] == part)
      result.own_coordinates.push_back(static_cast<int>(k));
  std::sort(result.own_coordinates.begin(), result.own_coordinates.end(),
            [&](int a, int b) { return result.kinematics.coordinates[a] < result.kinematics.coordinates[b]; });
  return result;
}

} // namespace gestell::fem
