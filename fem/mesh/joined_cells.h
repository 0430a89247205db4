#pragma once

#include "fem/values/mesh.h"
#include "fem/values/message_text.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace gestell::fem
{

/// Representative of the set that contains i, with path halving.
template <class Index>
Index root(std::vector<Index> &parent, Index i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

/// Pairs of equal faces join their cells in `parent`; returns single faces, the skin, in the order of their cells.
///
/// @param faces  with members key (of the corners), cell and face, sorted by them
/// @throws std::invalid_argument if more than two cells share a face
template <class CellFace>
std::vector<CellFace> join_cells(const std::vector<CellFace> &faces, std::vector<int> &parent, const std::string &head)
{
  std::vector<CellFace> skin;
  for (std::size_t i = 0; i < faces.size();)
  {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].key == faces[i].key)
      ++end;
    if (end - i > 2)
      throw std::invalid_argument(head + ": " + std::to_string(end - i) +
                                  " cells share one face; the mesh overlaps itself: unite the solids and mesh again.");
    if (end - i == 2)
      parent[root(parent, faces[i].cell)] = root(parent, faces[i + 1].cell);
    else
      skin.push_back(faces[i]);
    i = end;
  }
  std::sort(skin.begin(), skin.end(),
            [](auto &a, auto &b) { return std::tie(a.cell, a.face) < std::tie(b.cell, b.face); });
  return skin;
}

/// Adds a note for a surface with some elements that are faces of cells and others that are not: it has lost cells.
/// @param surface_of  tags of surfaces by the sorted corners of their elements, -1 for a node of no cell
/// @param is_face     whether such corners are those of a face
template <class Key, class IsFace>
void note_missing_cells(Mesh &mesh, const std::map<Key, int> &surface_of, const IsFace &is_face)
{
  std::map<int, std::vector<Key>> without; // elements without cells, by the tags of their surfaces
  std::set<int>                   with;
  for (const auto &[key, tag] : surface_of)
    if (is_face(key))
      with.insert(tag);
    else
      without[tag].push_back(key);
  std::size_t n     = 0;
  int         where = -1;
  for (const auto &[tag, elements] : without)
    if (with.count(tag) > 0)
    {
      n += elements.size();
      where = std::max(where, elements.front().back()); // nodes without a cell have no number
    }
  if (n > 0)
    mesh.notes.push_back(std::to_string(n) + " elements of surfaces" +
                         (where < 0 ? "" : ", one at " + text(mesh.points[where]) + " m,") +
                         " lie on no cell, though others of the same surfaces do: cells are missing there, as in a "
                         "truncated file; export the mesh again if they are intended");
}

/// Whether two cells are on opposite sides of their common face, for any numbering of its corners; flat cells are
/// checked elsewhere.
/// @param face  of the first cell, numbered as in cell_shape()
bool lie_apart(const Mesh &mesh, int first, int face, int second);

/// @param faces  as for join_cells()
/// @throws std::invalid_argument if cells are on the same side of their common face
template <class CellFace>
void require_unfolded(const Mesh &mesh, const std::vector<CellFace> &faces, const std::string &head)
{
  std::size_t n_folded = 0;
  int         where    = 0;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i)
    if (faces[i].key == faces[i + 1].key && !lie_apart(mesh, faces[i].cell, faces[i].face, faces[i + 1].cell))
    {
      ++n_folded;
      where = faces[i].cell;
    }
  if (n_folded > 0)
    throw std::invalid_argument(head + ": " + std::to_string(n_folded) +
                                " pairs of neighbouring cells lie on the same side of their common face, one at " +
                                text(mesh.points[mesh.corners(where)[0]]) +
                                " m: cells are turned inside out (negative Jacobian) or there twice; a node may have "
                                "been moved through its neighbours, or a volume drawn twice. Mesh again.");
}

} // namespace gestell::fem
