#pragma once

#include "fem/cell_materials.h"
#include "fem/kinematics.h"
#include "fem/quadratic_mesh.h"

#include <vector>

namespace gestell::fem
{

/// Which of `parts` every cell belongs to: parts alike in size, few faces between them (METIS, on the dual graph).
std::vector<int> part_cells(const QuadraticMesh &mesh, int parts);

/// Which part every node belongs to: the one with fewest nodes so far among those of its cells.
std::vector<int> part_nodes(const QuadraticMesh &mesh, const std::vector<int> &part_of_cell, int parts);

/// The cells of one part with their nodes and nothing else, as one rank needs them.
struct FramePart
{
  QuadraticMesh     mesh; ///< points and cells
  CellMaterials     materials;
  Kinematics::Lists kinematics;
};

/// @param nodes those of the part's cells in the whole mesh, ascending, are given back.
FramePart frame_part(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics,
                     const std::vector<int> &part_of_cell, int part, std::vector<int> &nodes);

} // namespace gestell::fem
