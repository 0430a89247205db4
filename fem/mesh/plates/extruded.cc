#include "fem/mesh/plates/extruded.h"

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/mixed_extraction.h"
#include "fem/mesh/plates/cell_widths.h"
#include "fem/mesh/plates/footprints.h"
#include "fem/mesh/plates/section_mesh.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::fem
{

namespace
{

constexpr double parallel   = 1e-5; // [rad], as of the faces of plates
constexpr double same_place = 1e-5; // of the extent: digits of CAD files
const double     pi         = std::acos(-1.);

Vector3 normal_to(const Vector3 &axis)
{
  const auto least =
      std::min_element(axis.begin(), axis.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  Vector3 other{};
  other[least - axis.begin()] = 1.;
  return unit(cross(axis, other));
}

/// Edges of one end face only, which are around the section.
std::vector<int> outer_edges(const std::vector<Face> &faces)
{
  std::map<int, int> count;
  for (const Face &face : faces)
    for (const int edge : face.edges)
      ++count[edge];
  std::vector<int> edges;
  for (const auto &[edge, n] : count)
    if (n == 1)
      edges.push_back(edge);
  return edges;
}

double area_of(const std::vector<Face> &faces)
{
  double area = 0.;
  for (const Face &face : faces)
    area += face.area;
  return area;
}

/// Radii and centre, if all sides are those of a tube.
void find_tube(Extruded &result)
{
  std::vector<double> radii;
  for (const Face &face : result.sides)
  {
    if (face.kind != FaceKind::cylinder)
      return;
    radii.push_back(face.radius);
  }
  const auto [inner, outer] = std::minmax_element(radii.begin(), radii.end());
  const auto middle         = [&](const Face &face) {
    return Point2{dot(face.through, result.axes[0]), dot(face.through, result.axes[1])};
  };
  const Point2 centre = middle(result.sides.front());
  for (const Face &face : result.sides)
    if (const Point2 own = middle(face); std::hypot(own[0] - centre[0], own[1] - centre[1]) > same_place * *outer ||
                                         std::min(face.radius - *inner, *outer - face.radius) > same_place * *outer)
      return;
  const double ring = pi * (*outer * *outer - *inner * *inner);
  if (*outer - *inner < same_place * *outer || std::abs(ring - result.area) > same_place * result.area)
    return; // a pin, or a half of a tube
  result.inner  = *inner;
  result.outer  = *outer;
  result.centre = centre;
}

std::optional<Extruded> extruded_along(const Vector3 &axis, const Solid &solid, const std::vector<Face> &faces,
                                       double unit)
{
  const Vector3 a = normal_to(axis);
  Extruded      result;
  result.axes = {a, cross(axis, a), axis};
  result.unit = unit;
  std::vector<Face> ends;
  for (const Face &face : faces)
  {
    if (face.kind == FaceKind::plane && norm(cross(face.direction, axis)) < parallel)
      ends.push_back(face);
    else if (std::all_of(face.samples.begin(), face.samples.end(),
                         [&](const Face::Sample &sample) { return std::abs(dot(sample.normal, axis)) < parallel; }))
      result.sides.push_back(face);
    else
      return std::nullopt;
  }
  const auto level = [&](const Face &face) { return dot(face.through, axis); };
  if (ends.empty() || result.sides.empty())
    return std::nullopt;
  const auto [low, high] =
      std::minmax_element(ends.begin(), ends.end(), [&](auto &x, auto &y) { return level(x) < level(y); });
  result.from                 = level(*low);
  result.to                   = level(*high);
  const double      tolerance = same_place * norm(solid.max - solid.min);
  std::vector<Face> lower, upper;
  for (const Face &face : ends)
  {
    if (std::min(level(face) - result.from, result.to - level(face)) > tolerance)
      return std::nullopt;
    (level(face) - result.from < result.to - level(face) ? lower : upper).push_back(face);
    result.ends.push_back(plate_face(face, {result.axes, 2, unit}));
  }
  result.area               = area_of(lower);
  const double     volume   = result.area * (result.to - result.from);
  constexpr double rounding = 1e-4; // of the volume: a slot or a cut takes more
  if (!(result.to - result.from > tolerance) || std::abs(volume - solid.volume) > rounding * solid.volume ||
      std::abs(area_of(upper) - result.area) > rounding * result.area)
    return std::nullopt;
  result.outline = outer_edges(lower.size() <= upper.size() ? lower : upper);
  find_tube(result);
  return result;
}

/// Rings of quadrilaterals.
SectionMesh ring_section(const Extruded &tube, const MeshOptions &options)
{
  constexpr int    n_sides   = 12;      // equal areas give the second moment of a ring to 0.15 %
  constexpr double layer     = 1. / 4.; // of the radius: in thicker walls stresses are not linear across
  const double     thickness = tube.outer - tube.inner, scale = corner_factor(2. * pi / n_sides);
  const int        n = std::max(
             {options.layers, thickness > layer * tube.outer ? 2 : 1, static_cast<int>(std::ceil(thickness / options.size))});
  SectionMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < n_sides; ++i)
    {
      const double r = scale * (tube.inner + thickness * j / n), phi = 2. * pi * i / n_sides;
      mesh.points.push_back({tube.centre[0] + r * std::cos(phi), tube.centre[1] + r * std::sin(phi)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n_sides; ++i)
    {
      const int next = (i + 1) % n_sides, in = j * n_sides, out = in + n_sides;
      mesh.quadrilaterals.push_back({in + i, out + i, out + next, in + next});
    }
  return mesh;
}

/// Longest side of each loop: as cells grow from one to the next, sides are at most three times as long as the way to
/// the nearest other loop.
std::vector<double> longest_sides(const std::vector<std::vector<int>> &loops, const DrawingPlane &plane, double size)
{
  constexpr double    ratio = 3.;
  std::vector<double> longest;
  for (const std::vector<int> &loop : loops)
  {
    const std::vector<Side> sides = face_loop(loop, plane).sides;
    double                  apart = size;
    for (const std::vector<int> &other : loops)
      if (&other != &loop)
        apart = std::min(apart, gap_between(sides, face_loop(other, plane).sides));
    longest.push_back(std::clamp(ratio * apart, 1e-3 * size, size));
  }
  return longest;
}

/// Quadrilaterals between the outline, holes and footprints on the ends.
SectionMesh plane_section(const Extruded &extruded, const std::set<int> &contacts, const MeshOptions &options)
{
  const DrawingPlane            plane{extruded.axes, 2, extruded.unit};
  std::vector<std::vector<int>> loops   = loops_of(extruded.outline);
  const std::size_t             n_holes = loops.size();
  for (const PlateFace &face : extruded.ends)
    if (const FaceLoop *footprint = outer_loop(face); contacts.count(face.tag) > 0 && footprint)
      if (std::none_of(loops.begin(), loops.end(),
                       [&](const std::vector<int> &other)
                       { return touch(face_loop(other, plane).sides, footprint->sides); }))
        loops.push_back(footprint->edges);
  const std::vector<double> longest = longest_sides(loops, plane, options.size);
  std::vector<Outline>      outlines;
  for (std::size_t i = 0; i < loops.size(); ++i)
    outlines.push_back(of_equal_area(outline_of(loops[i], plane, longest[i])));
  const auto extent = [](const Outline &o) { return std::hypot(o.max[0] - o.min[0], o.max[1] - o.min[1]); };
  const auto around = std::max_element(outlines.begin(), outlines.begin() + static_cast<std::ptrdiff_t>(n_holes),
                                       [&](const Outline &a, const Outline &b) { return extent(a) < extent(b); }) -
                      outlines.begin();
  std::vector<InnerLine> lines;
  for (std::size_t i = 0; i < outlines.size(); ++i)
    if (static_cast<std::ptrdiff_t>(i) != around)
      lines.push_back({corners_of(outlines[i]), i >= n_holes});
  return section_mesh(corners_of(outlines[around]), lines);
}

/// The face to which a point is nearest, among those that reach there; 0 for none.
int nearest_face(const std::vector<Face> &faces, const Vector3 &x, double unit)
{
  const Vector3 in_units = (1. / unit) * x;
  int           found    = 0;
  double        distance = 1e300;
  for (const Face &face : faces)
  {
    std::vector<double> foot, uv;
    gmsh::model::getClosestPoint(2, face.tag, {in_units[0], in_units[1], in_units[2]}, foot, uv);
    if (foot.size() != 3 || uv.size() != 2 || gmsh::model::isInside(2, face.tag, uv) == 0)
      continue;
    if (const double own = norm(Vector3{foot[0], foot[1], foot[2]} - in_units); own < distance)
    {
      distance = own;
      found    = face.tag;
    }
  }
  return found;
}

int surface_at(const Extruded &extruded, const Vector3 &x)
{
  const double level = dot(x, extruded.axes[2]), tolerance = same_place * (extruded.to - extruded.from);
  if (std::min(level - extruded.from, extruded.to - level) > tolerance)
    return nearest_face(extruded.sides, x, extruded.unit);
  const bool upper = extruded.to - level < level - extruded.from;
  for (const PlateFace &face : extruded.ends)
    if ((extruded.to - face.level < face.level - extruded.from) == upper &&
        PlateSolids::contains(face, {dot(x, extruded.axes[0]), dot(x, extruded.axes[1])}))
      return face.tag;
  return 0;
}

/// Limits of cells along the axis: narrow at the ends, which are welded to others.
std::vector<double> levels_of(const Extruded &extruded, const MeshOptions &options)
{
  double around = 0.;
  for (const Face &side : extruded.sides)
    around += side.area / (extruded.to - extruded.from);
  Sheet along;
  along.from           = extruded.from;
  along.to             = extruded.to;
  along.thickness      = std::min(2. * extruded.area / around, along.width());
  along.mostly_goes_on = {true, true};
  return cell_limits(along, options.size, options.layers);
}

} // namespace

std::optional<Extruded> extruded(const Solid &solid, const std::vector<Face> &all, double unit)
{
  std::vector<Face> faces;
  for (const Face &face : all)
    if (std::count(solid.faces.begin(), solid.faces.end(), face.tag) > 0)
      faces.push_back(face);
  std::optional<Extruded> shortest;
  for (const Face &face : faces)
    if (face.kind == FaceKind::plane)
      if (auto found = extruded_along(face.direction, solid, faces, unit);
          found && (!shortest || found->to - found->from < shortest->to - shortest->from))
        shortest = std::move(found);
  return shortest;
}

bool carries_others(const Extruded &extruded, const std::set<int> &contacts)
{
  const std::set<int> around(extruded.outline.begin(), extruded.outline.end());
  for (const PlateFace &face : extruded.ends)
    if (contacts.count(face.tag) > 0)
      for (const FaceLoop &loop : face.loops)
        if (std::none_of(loop.edges.begin(), loop.edges.end(), [&](int edge) { return around.count(edge) > 0; }))
          return true;
  return false;
}

ExtractedMesh extruded_mesh(const Extruded &extruded, const Solid &solid, const std::set<int> &contacts,
                            const MeshOptions &options, const std::string &head)
{
  const SectionMesh section =
      extruded.outer > 0. ? ring_section(extruded, options) : plane_section(extruded, contacts, options);
  const std::vector<double> levels = levels_of(extruded, options);
  ExtractedMesh             result;
  Mesh                     &mesh = result.mesh;
  mesh.solids.push_back(solid.name);
  for (const double level : levels)
    for (const Point2 &x : section.points)
      mesh.points.push_back(x[0] * extruded.axes[0] + x[1] * extruded.axes[1] + level * extruded.axes[2]);
  const auto n = static_cast<int>(section.points.size());
  for (int k = 0; k + 1 < static_cast<int>(levels.size()); ++k)
    for (const auto &[a, b, c, d] : section.quadrilaterals)
    {
      const int low = k * n, high = low + n;
      mesh.hexahedra.push_back({low + a, low + b, low + c, low + d, high + a, high + b, high + c, high + d});
      mesh.cell_solid.push_back(0);
      constexpr double worst_corner = 0.02; // corner_quality(), as around holes
      if (corner_quality(mesh, mesh.n_cells() - 1) < worst_corner)
        throw NotSwept("cells of its section would fold");
    }
  const auto surface_of = [&](const std::vector<int> &corners)
  {
    Vector3 centre{};
    for (const int corner : corners)
      centre = centre + (1. / double(corners.size())) * mesh.points[corner];
    return surface_at(extruded, centre);
  };
  try
  {
    add_skin(result, head, 0, surface_of);
  }
  catch (const std::invalid_argument &)
  {
    throw NotSwept("cells of its section overlap");
  }
  return result;
}

} // namespace gestell::fem
