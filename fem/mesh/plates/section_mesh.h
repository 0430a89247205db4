#pragma once

#include "fem/mesh/plates/plate_faces.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/// Plane mesh in quadrilaterals, counterclockwise.
struct SectionMesh
{
  std::vector<Point2>             points;
  std::vector<std::array<int, 4>> quadrilaterals;
};

/**
 * Meshes the area within an outline around holes; each side is one side of a cell.  gmsh meshes between every second
 * point, in a model of its own beside the others, in quadrilaterals and triangles; these are divided into four and
 * three about their middles, and what was left out of the outline is put where it was given.  So there are
 * quadrilaterals alone: deal.II 9.4 goes out of its memory where it numbers hexahedra with prisms among them.
 *
 * @param outline  an even number of points around it, corners of the area at even places [m]; of holes alike
 * @throws NotSwept where gmsh cannot
 */
SectionMesh section_mesh(const std::vector<Point2> &outline, const std::vector<std::vector<Point2>> &holes);

} // namespace gestell::fem
