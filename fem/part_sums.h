#pragma once

#include "fem/cell_parts.h"
#include "fem/weighing.h"

namespace gestell::fem
{

/// Rows of a sparse matrix, compressed.
struct CompressedRows
{
  std::vector<int>    begin{0}, column; ///< entries of row i: from begin[i] to begin[i + 1]
  std::vector<double> value;

  int n_rows() const { return static_cast<int>(begin.size()) - 1; }
};

/// What the cells add up to for the coordinates and nodes of one part.
struct PartSums
{
  CompressedRows C, M;     ///< of own_coordinates; columns as numbered in the part
  RigidEnergies  energies; ///< of own_nodes
  NodalMasses    masses;   ///< of own_nodes
};

/// Each number is the same sum in the same order as that of the whole frame, see sum_cells(); energies are that part of
/// it.
/// @param middle of the nodes of the whole frame.
PartSums sum_part(const FramePart &part, const Eigen::Vector3d &middle);

} // namespace gestell::fem
