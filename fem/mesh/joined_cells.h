#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace gestell::fem
{

/// Representative of the set that holds i; paths are halved on the way.
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
/// @throws std::invalid_argument where more than two cells share a face
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

} // namespace gestell::fem
