#pragma once

#include "fem/mesh/plates/plate_faces.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/// Plane mesh of quadrilaterals, counterclockwise.
struct SectionMesh
{
  std::vector<Point2>             points;
  std::vector<std::array<int, 4>> quadrilaterals;
};

/// A closed line in a section, around a hole or only along sides of cells.
struct InnerLine
{
  std::vector<Point2> points;
  bool                filled = false;
};

/**
 * Meshes the area between an outline and holes; each side is one side of a cell.  gmsh meshes between every second
 * point with quadrilaterals and triangles, in a separate model.  These are divided into four or three cells about their
 * centres, and the omitted points of the outline are moved to their given positions.  The result contains only
 * quadrilaterals, so that the plate consists of hexahedra alone.
 *
 * @param outline  an even number of points around it, with corners of the area at even indices [m]; the same applies to
 *   lines within
 * @throws NotSwept if gmsh fails
 */
SectionMesh section_mesh(const std::vector<Point2> &outline, const std::vector<InnerLine> &lines);

} // namespace gestell::fem
