#pragma once

#include "fem/cell_materials.h"
#include "fem/kinematics.h"
#include "fem/quadratic_mesh.h"

#include <vector>

namespace gestell::fem
{

/// Which of several parts of a frame every node, and every coordinate of q, belongs to.
struct FrameDivision
{
  std::vector<int> part_of_node, part_of_coordinate;
};

/**
 * Cells are parted alike in size with few faces between them (METIS, on the dual graph); a node goes to the part with
 * fewest nodes so far among those of its cells, a displacement with its node, any other coordinate with the first node
 * that follows it.
 */
FrameDivision divide(const QuadraticMesh &mesh, const Kinematics &kinematics, int parts);

/**
 * What one rank needs to sum up the rows of its coordinates without others: the cells at its nodes, and at all nodes
 * that follow one of its coordinates; so those next to other parts belong to several.
 *
 * Cells and nodes stand in the order of the whole mesh.
 */
struct FramePart
{
  QuadraticMesh     mesh; ///< points and cells
  CellMaterials     materials;
  Kinematics::Lists kinematics;
  std::vector<int>  own_nodes;       ///< those that belong to the part, as numbered in `mesh`; ascending
  std::vector<int>  own_coordinates; ///< those that belong to the part, as numbered in `kinematics`; in the order of q
};

/// @param nodes those of the part's cells in the whole mesh, ascending, are given back.
FramePart frame_part(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics,
                     const FrameDivision &division, int part, std::vector<int> &nodes);

} // namespace gestell::fem
