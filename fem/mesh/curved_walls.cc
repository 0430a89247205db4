#include "fem/mesh/curved_walls.h"

#include "fem/values/two_pi.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

namespace gestell::fem
{

namespace
{

/// sqrt(2 R d), of a wall that runs out to nothing not less than 2 pi R/200.
double size_at(double R, double d)
{
  constexpr double most_around = 200.; // elements around a circle: enough for walls of R/2000
  return std::max(std::sqrt(2. * R * d), two_pi * R / most_around);
}

struct NearFace
{
  int              tag;
  bool             curved;
  Vector3          min, max;
  std::vector<int> curves; ///< of its boundary, ascending
};

std::vector<NearFace> faces_of_model()
{
  std::vector<NearFace> faces;
  gmsh::vectorpair      surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto &[dim, tag] : surfaces)
  {
    NearFace    face{tag, false, {}, {}, {}};
    std::string type;
    gmsh::model::getType(dim, tag, type);
    face.curved = type != "Plane";
    gmsh::model::getBoundingBox(dim, tag, face.min[0], face.min[1], face.min[2], face.max[0], face.max[1], face.max[2]);
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{dim, tag}}, boundary, false, false, false);
    for (const auto &[curve_dim, curve] : boundary)
      face.curves.push_back(curve);
    std::sort(face.curves.begin(), face.curves.end());
    faces.push_back(face);
  }
  return faces;
}

bool share_a_curve(const NearFace &a, const NearFace &b)
{
  return std::any_of(a.curves.begin(), a.curves.end(),
                     [&](int curve) { return std::binary_search(b.curves.begin(), b.curves.end(), curve); });
}

double distance_from_box(const NearFace &face, const Vector3 &x)
{
  Vector3 apart{};
  for (int d = 0; d < 3; ++d)
    apart[d] = std::max({0., face.min[d] - x[d], x[d] - face.max[d]});
  return norm(apart);
}

/// gmsh's nearest points on a face, or on its surface beyond its boundary.
std::vector<Vector3> feet_on(int face, const std::vector<double> &points)
{
  std::vector<double> feet, parameters;
  if (!points.empty())
    gmsh::model::getClosestPoint(2, face, points, feet, parameters);
  std::vector<Vector3> result;
  for (std::size_t i = 0; i + 2 < feet.size(); i += 3)
    result.push_back({feet[i], feet[i + 1], feet[i + 2]});
  return result;
}

struct Across
{
  double          distance;       ///< infinite: none within reach
  const NearFace *face = nullptr; ///< that does not adjoin the first
};

/// The nearest face along the normal of a face, to either side.
Across face_across(const std::vector<NearFace> &faces, const NearFace &from, const Vector3 &x, const Vector3 &normal,
                   double reach)
{
  Across nearest{reach};
  for (const NearFace &face : faces)
  {
    if (face.tag == from.tag || distance_from_box(face, x) >= nearest.distance || share_a_curve(face, from))
      continue;
    const std::vector<Vector3> feet = feet_on(face.tag, {x[0], x[1], x[2]});
    if (feet.empty())
      continue;
    const double     d       = norm(feet[0] - x);
    constexpr double across  = 0.9;  // cosine of the angle to the normal: others are beside the point
    constexpr double outside = 1e-3; // of the distance: rounding of boxes
    if (d < nearest.distance && std::abs(dot(feet[0] - x, normal)) > across * d &&
        distance_from_box(face, feet[0]) <= outside * d)
      nearest = {d, &face};
  }
  return nearest;
}

/// Of both faces of a wall: polygons of equal sides take the same from the circles on both sides, (pi/6) l^2, so that
/// the volume of the wall stays.
void limit_size(FaceSizes &sizes, const NearFace &face, const NearFace &across, double size)
{
  for (const NearFace *side : {&face, &across})
    if (side->curved)
      if (const auto [entry, is_new] = sizes.try_emplace(side->tag, size); !is_new)
        entry->second = std::min(entry->second, size);
}

struct LongSides
{
  std::vector<double> middles; ///< coordinates
  std::vector<double> lengths;
};

/// The longest side of each triangle on a face.
LongSides long_sides(int face)
{
  std::vector<std::size_t> tags, elements, nodes;
  std::vector<double>      x, parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters, 2, face, /* boundary */ true, false);
  std::unordered_map<std::size_t, Vector3> points;
  for (std::size_t i = 0; i < tags.size(); ++i)
    points[tags[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
  constexpr int triangle = 2; // gmsh's types of elements
  gmsh::model::mesh::getElementsByType(triangle, elements, nodes, face);
  LongSides sides;
  for (std::size_t i = 0; i + 2 < nodes.size(); i += 3)
  {
    double  longest = 0.;
    Vector3 middle{};
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 &a = points.at(nodes[i + k]), &b = points.at(nodes[i + (k + 1) % 3]);
      if (norm(b - a) > longest)
      {
        longest = norm(b - a);
        middle  = 0.5 * (a + b);
      }
    }
    sides.middles.insert(sides.middles.end(), middle.begin(), middle.end());
    sides.lengths.push_back(longest);
  }
  return sides;
}

void limit_cutting(FaceSizes &sizes, const std::vector<NearFace> &faces, const NearFace &face)
{
  constexpr double           limit = 2. / 3., straight_side = 1e-4; // of d and of the length
  const LongSides            sides = long_sides(face.tag);
  const std::vector<Vector3> feet  = feet_on(face.tag, sides.middles);
  for (std::size_t i = 0; i < std::min(feet.size(), sides.lengths.size()); ++i)
  {
    const Vector3 middle = {sides.middles[3 * i], sides.middles[3 * i + 1], sides.middles[3 * i + 2]};
    const double  length = sides.lengths[i], delta = norm(feet[i] - middle);
    if (!(delta > straight_side * length))
      continue;
    const Across wall = face_across(faces, face, feet[i], (1. / delta) * (feet[i] - middle), delta / limit);
    if (wall.face)
      limit_size(sizes, face, *wall.face, size_at(length * length / (8. * delta), wall.distance));
  }
}

/// At points of a grid of the parameters of a face.
void limit_by_walls(FaceSizes &sizes, const std::vector<NearFace> &faces, const NearFace &face, double size)
{
  constexpr double    shares[] = {0.1, 0.5, 0.9}; // of both parameters: apart from the edges
  std::vector<double> low, high;
  gmsh::model::getParametrizationBounds(2, face.tag, low, high);
  for (const double u : shares)
    for (const double v : shares)
    {
      const std::vector<double> at = {low[0] + u * (high[0] - low[0]), low[1] + v * (high[1] - low[1])};
      std::vector<double>       x, normal, curvature;
      gmsh::model::getValue(2, face.tag, at, x);
      gmsh::model::getNormal(face.tag, at, normal);
      gmsh::model::getCurvature(2, face.tag, at, curvature);
      if (curvature.empty() || !(std::abs(curvature[0]) > 0.) || x.size() < 3 || normal.size() < 3)
        continue;
      const double R    = 1. / std::abs(curvature[0]);
      const Across wall = face_across(faces, face, {x[0], x[1], x[2]}, {normal[0], normal[1], normal[2]},
                                      size * size / (2. * R)); // beyond, the size is small enough
      if (wall.face)
        limit_size(sizes, face, *wall.face, size_at(R, wall.distance));
    }
}

template <typename Limit>
FaceSizes sizes_of_curved_faces(const Limit &limit)
{
  const std::vector<NearFace> faces = faces_of_model();
  FaceSizes                   sizes;
  for (const NearFace &face : faces)
    if (face.curved)
      limit(sizes, faces, face);
  return sizes;
}

} // namespace

FaceSizes faces_that_cut_walls()
{
  return sizes_of_curved_faces(limit_cutting);
}

FaceSizes sizes_by_walls(double size)
{
  return sizes_of_curved_faces([size](FaceSizes &sizes, const std::vector<NearFace> &faces, const NearFace &face)
                               { limit_by_walls(sizes, faces, face, size); });
}

} // namespace gestell::fem
