#pragma once

#include "fem/mesh/plates/plate_faces.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/// Plane mesh in quadrilaterals and triangles, counterclockwise.
struct SectionMesh
{
  std::vector<Point2>             points; ///< first those of the outline and the holes, as they were given
  std::vector<std::array<int, 4>> quadrilaterals;
  std::vector<std::array<int, 3>> triangles;
};

/**
 * Meshes the area within an outline around holes; each side is one side of a cell.  gmsh makes it in a model of its own
 * and keeps the others.
 *
 * @param outline  points around it [m]
 * @throws NotSwept where gmsh cannot
 */
SectionMesh section_mesh(const std::vector<Point2> &outline, const std::vector<std::vector<Point2>> &holes);

} // namespace gestell::fem
