#include "fem/mesh/plates/tubes.h"

#include "fem/mesh/mixed_extraction.h"
#include "fem/mesh/plates/cell_widths.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>

namespace gestell::fem
{

namespace
{

constexpr int    sides_of_tube = 12; // equal areas give the second moment of a ring to 0.15 %
const double     pi            = std::acos(-1.);
constexpr double same          = 1e-5; // of the outer radius: digits of CAD files

/// Of the corners of a polygon with the area of a circle of radius 1.
double corner_radius()
{
  const double sector = 2. * pi / sides_of_tube;
  return std::sqrt(sector / std::sin(sector));
}

Vector3 normal_to(const Vector3 &axis)
{
  Vector3 other{};
  other[std::min_element(axis.begin(), axis.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
        axis.begin()] = 1.;
  return unit(cross(axis, other));
}

bool is_inside(const Face &face, const Vector3 &x, double length_unit)
{
  const Vector3       in_units = (1. / length_unit) * x;
  std::vector<double> uv;
  gmsh::model::getParametrization(2, face.tag, {in_units[0], in_units[1], in_units[2]}, uv);
  return uv.size() == 2 && gmsh::model::isInside(2, face.tag, uv) > 0;
}

class Rings
{
public:
  Rings(const Tube &tube, const MeshOptions &options) : tube_(tube)
  {
    const double thickness = tube.outer - tube.inner;
    Sheet        along;
    along.from           = tube.from;
    along.to             = tube.to;
    along.thickness      = thickness;
    along.mostly_goes_on = {true, true}; // ends are welded to walls
    levels_              = cell_limits(along, options.size, 1);
    const int n          = std::max({options.layers, thickness > layer * tube.outer ? 2 : 1,
                                     static_cast<int>(std::ceil(thickness / options.size))});
    for (int i = 0; i <= n; ++i)
      radii_.push_back(tube.inner + thickness * i / n);
  }

  void add_to(Mesh &mesh) const
  {
    const double scale = corner_radius();
    for (const double level : levels_)
      for (const double r : radii_)
        for (int i = 0; i < sides_of_tube; ++i)
        {
          const double phi = 2. * pi * i / sides_of_tube;
          mesh.points.push_back(tube_.origin + level * tube_.axes[2] +
                                scale * r * (std::cos(phi) * tube_.axes[0] + std::sin(phi) * tube_.axes[1]));
        }
    for (std::size_t k = 0; k + 1 < levels_.size(); ++k)
      for (std::size_t j = 0; j + 1 < radii_.size(); ++j)
        for (int i = 0; i < sides_of_tube; ++i)
        {
          const auto at = [&](std::size_t level, std::size_t radius, int side)
          { return static_cast<int>((level * radii_.size() + radius) * sides_of_tube) + side % sides_of_tube; };
          mesh.hexahedra.push_back({at(k, j, i), at(k, j + 1, i), at(k, j + 1, i + 1), at(k, j, i + 1), at(k + 1, j, i),
                                    at(k + 1, j + 1, i), at(k + 1, j + 1, i + 1), at(k + 1, j, i + 1)});
          mesh.cell_solid.push_back(0);
        }
  }

private:
  static constexpr double layer = 1. / 4.; // of the radius: thicker walls have stresses that are not linear in it
  const Tube             &tube_;
  std::vector<double>     levels_, radii_;
};

/// Face of the tube on which an outer face of its cells is.
int surface_of(const Tube &tube, const Vector3 &centre, double unit)
{
  const Vector3 r     = centre - tube.origin;
  const double  level = dot(r, tube.axes[2]), radius = norm(r - level * tube.axes[2]);
  const bool    at_end = level - tube.from < same * tube.outer || tube.to - level < same * tube.outer;
  if (at_end)
  {
    const Point2 x   = {dot(centre, tube.axes[0]), dot(centre, tube.axes[1])};
    const double own = dot(centre, tube.axes[2]);
    for (const PlateFace &face : tube.ends)
      if (std::abs(face.level - own) < same * tube.outer && PlateSolids::contains(face, x))
        return face.tag;
    return 0;
  }
  const double  wanted = radius > 0.5 * (tube.inner + tube.outer) ? tube.outer : tube.inner;
  const Vector3 on     = tube.origin + level * tube.axes[2] + (wanted / radius) * (r - level * tube.axes[2]);
  int           found  = 0;
  double        area   = 1e300;
  for (const Face &face : tube.sides) // a contact within another face comes first
    if (std::abs(face.radius - wanted) < same * tube.outer && face.area < area && is_inside(face, on, unit))
    {
      found = face.tag;
      area  = face.area;
    }
  return found;
}

} // namespace

std::optional<Tube> tube_of(const Solid &solid, const std::vector<Face> &all, double unit)
{
  Tube                tube;
  std::vector<double> levels;
  std::vector<Face>   plane;
  for (const Face &face : all)
    if (std::count(solid.faces.begin(), solid.faces.end(), face.tag) > 0)
    {
      if (face.kind == FaceKind::other)
        return std::nullopt;
      (face.kind == FaceKind::cylinder ? tube.sides : plane).push_back(face);
    }
  tube.unit = unit;
  if (tube.sides.empty() || plane.empty())
    return std::nullopt;
  const Vector3 axis = tube.sides.front().direction, a = normal_to(axis);
  tube.axes   = {a, cross(axis, a), axis};
  tube.origin = tube.sides.front().through;
  for (const Face &face : tube.sides)
    tube.outer = std::max(tube.outer, face.radius);
  tube.inner = tube.outer;
  for (const Face &face : tube.sides)
    tube.inner = std::min(tube.inner, face.radius);
  const double tolerance = same * tube.outer;
  for (const Face &face : tube.sides)
  {
    const Vector3 aside = face.through - tube.origin;
    if (norm(cross(face.direction, axis)) > same || norm(aside - dot(aside, axis) * axis) > tolerance ||
        std::min(face.radius - tube.inner, tube.outer - face.radius) > tolerance)
      return std::nullopt;
  }
  for (const Face &face : plane)
  {
    if (norm(cross(face.direction, axis)) > same)
      return std::nullopt;
    levels.push_back(dot(face.through - tube.origin, axis));
    tube.ends.push_back(plate_face(face, {tube.axes, 2, unit}));
  }
  const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
  tube.from              = *low;
  tube.to                = *high;
  for (const double level : levels)
    if (std::min(level - tube.from, tube.to - level) > tolerance)
      return std::nullopt;
  const double     volume   = pi * (tube.outer * tube.outer - tube.inner * tube.inner) * (tube.to - tube.from);
  constexpr double rounding = 1e-4; // of the volume: a slot or a cut takes more
  if (tube.outer - tube.inner < tolerance || std::abs(volume - solid.volume) > rounding * volume)
    return std::nullopt;
  return tube;
}

ExtractedMesh tube_mesh(const Tube &tube, const Solid &solid, const MeshOptions &options, const std::string &head)
{
  ExtractedMesh result;
  Rings(tube, options).add_to(result.mesh);
  result.mesh.solids.push_back(solid.name);
  const Mesh  &mesh = result.mesh;
  const double unit = tube.unit;
  add_skin(result, head, 0,
           [&](const std::vector<int> &corners)
           {
             Vector3 centre{};
             for (const int corner : corners)
               centre = centre + (1. / double(corners.size())) * mesh.points[corner];
             return surface_of(tube, centre, unit);
           });
  return result;
}

} // namespace gestell::fem
