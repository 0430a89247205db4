#include "fem/geometry/small_features.h"

#include "fem/geometry/cad_shape.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <cmath>
#include <set>

namespace gestell::fem
{

namespace
{

double length_of(int edge, double unit)
{
  double length = 0.;
  gmsh::model::occ::getMass(1, edge, length);
  return unit * length;
}

/// Width 2 A / P; the seam of a closed face does not count as an edge.
double width_of(int face, double area, double unit)
{
  gmsh::vectorpair edges;
  gmsh::model::getBoundary({{2, face}}, edges, /* combined */ true, /* oriented */ false, /* recursive */ false);
  double perimeter = 0.;
  for (const auto &[dim, tag] : edges)
    perimeter += length_of(tag, unit);
  return perimeter > 0. ? 2. * area / perimeter : INFINITY;
}

} // namespace

SmallFeatures small_features(const CadModel &model, double limit)
{
  SmallFeatures result;
  result.shortest_edge = result.narrowest_face = INFINITY;
  gmsh::vectorpair edges;
  gmsh::model::getEntities(edges, 1);
  const std::set<int> degenerate = degenerate_edges(model);
  for (const auto &[dim, tag] : edges)
  {
    if (degenerate.count(tag) > 0)
      continue;
    const double length = length_of(tag, model.unit);
    result.n_short_edges += length < limit;
    if (length >= result.shortest_edge)
      continue;
    result.shortest_edge = length;
    Vector3 low, high;
    gmsh::model::getBoundingBox(1, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    result.edge_at = (0.5 * model.unit) * (low + high);
  }
  for (const Face &face : model.faces)
  {
    const double width = width_of(face.tag, face.area, model.unit);
    result.n_narrow_faces += width < limit;
    if (width >= result.narrowest_face)
      continue;
    result.narrowest_face = width;
    result.face           = face.tag;
    result.face_at        = face.centre;
  }
  return result;
}

std::vector<int> faces_smaller_than(const CadModel &model, double size)
{
  std::vector<int> tags;
  for (const Face &face : model.faces)
  {
    const bool slender = face.kind == FaceKind::cylinder && 2. * face.radius < size;
    if (slender || width_of(face.tag, face.area, model.unit) < size)
      tags.push_back(face.tag);
  }
  return tags;
}

std::string describe(const SmallFeatures &features)
{
  std::string words;
  if (features.shortest_edge < INFINITY)
    words += "shortest edge " + text(1e3 * features.shortest_edge) + " mm at " + text(features.edge_at);
  if (features.narrowest_face < INFINITY)
    words += std::string(words.empty() ? "" : "; ") + "narrowest face " + std::to_string(features.face) + ", " +
             text(1e3 * features.narrowest_face) + " mm wide at " + text(features.face_at);
  return words;
}

} // namespace gestell::fem
