#include "fem/mesh/plates/plate_faces.h"

#include "fem/geometry/gmsh_faces.h"
#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gestell::fem
{

namespace
{

constexpr double right_angle      = 1e-5; // [rad] by which normals may differ from an axis
constexpr int    points_of_curves = 64;   // that bound a face

using Axes = std::array<Vector3, 3>;

/// All faces of the solids, including those between two solids.
std::vector<Face> all_faces(const CadModel &model)
{
  std::vector<Face> faces = model.faces;
  for (Face &face : inner_faces(model.unit, model.diagonal()))
    faces.push_back(std::move(face));
  return faces;
}

/// The direction along which plane faces have most area among those at right angles to `others`.
Vector3 main_direction(const std::vector<Face> &faces, const std::vector<Vector3> &others)
{
  struct Along
  {
    Vector3 n;
    double  area;
  };
  std::vector<Along> found;
  for (const Face &face : faces)
  {
    if (face.kind != FaceKind::plane ||
        std::any_of(others.begin(), others.end(),
                    [&](const Vector3 &other) { return std::abs(dot(other, face.direction)) > right_angle; }))
      continue;
    const auto same =
        std::find_if(found.begin(), found.end(),
                     [&](const Along &along) { return norm(cross(along.n, face.direction)) < right_angle; });
    same == found.end() ? found.push_back({face.direction, face.area}) : void(same->area += face.area);
  }
  if (found.empty())
    throw NotSwept("no plane faces of the solids are at right angles to each other");
  return std::max_element(found.begin(), found.end(), [](auto &a, auto &b) { return a.area < b.area; })->n;
}

/// Without the rounding of a normal along a coordinate.
Vector3 rounded(Vector3 n)
{
  for (double &component : n)
    if (std::abs(component - std::round(component)) < 1e-9)
      component = std::round(component) + 0.;
  return n;
}

Axes main_axes(const std::vector<Face> &faces)
{
  const Vector3 a = rounded(main_direction(faces, {}));
  Vector3       b = main_direction(faces, {a});
  b               = rounded(unit(b - dot(a, b) * a));
  return {a, b, cross(a, b)};
}

Vector3 in(const Axes &axes, const Vector3 &x)
{
  return {dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)};
}

bool is_line(int curve)
{
  std::string type;
  gmsh::model::getType(1, curve, type);
  return type == "Line";
}

/// Points along a curve, in n equal steps of its parameter [m].
std::vector<Vector3> points_along(int curve, double unit, int n)
{
  std::vector<double> low, high, at, x;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  for (int i = 0; i <= n; ++i)
    at.push_back(low[0] + (high[0] - low[0]) * i / n);
  gmsh::model::getValue(1, curve, at, x);
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < x.size(); i += 3)
    points.push_back(unit * Vector3{x[i], x[i + 1], x[i + 2]});
  return points;
}

std::vector<int> ends_of(int curve)
{
  std::vector<int> above, points;
  gmsh::model::getAdjacencies(1, curve, above, points);
  return points;
}

/// Groups of edges that are connected at their ends.
std::vector<std::vector<int>> loops_of(const std::vector<int> &edges)
{
  std::vector<std::pair<std::set<int>, std::vector<int>>> loops; // ends, edges
  for (const int edge : edges)
  {
    std::pair<std::set<int>, std::vector<int>> joined;
    for (const int end : ends_of(edge))
      joined.first.insert(end);
    joined.second.push_back(edge);
    for (std::size_t i = 0; i < loops.size();)
      if (std::any_of(loops[i].first.begin(), loops[i].first.end(), [&](int p) { return joined.first.count(p) > 0; }))
      {
        joined.first.insert(loops[i].first.begin(), loops[i].first.end());
        joined.second.insert(joined.second.end(), loops[i].second.begin(), loops[i].second.end());
        loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(i));
      }
      else
        ++i;
    loops.push_back(std::move(joined));
  }
  std::vector<std::vector<int>> result;
  for (auto &loop : loops)
    result.push_back(std::move(loop.second));
  return result;
}

class Reader
{
public:
  Reader(const CadModel &model) : model_(model), read_(all_faces(model)), axes_(main_axes(read_))
  {
    for (const Face &face : read_)
      for (const int edge : face.edges)
        neighbours_[edge].push_back(&face);
  }

  PlateSolids solids()
  {
    result_.axes = axes_;
    for (const Face &face : read_)
      if (const int d = direction_of(face); d >= 0)
        add(face, d);
    find_holes();
    drop_walls();
    for (const Face &face : read_)
      if (index_.count(face.tag) == 0 && walls_.count(face.tag) == 0)
        throw NotSwept(describe(face) +
                       ", is neither at right angles to the others nor the wall of a hole straight through a plate");
    for (const Solid &solid : model_.solids)
    {
      result_.of_solid.emplace_back();
      for (const int tag : solid.faces)
        if (const auto face = index_.find(tag); face != index_.end())
          result_.of_solid.back().push_back(face->second);
    }
    return std::move(result_);
  }

private:
  /// The axis that is normal to the face; -1 if there is none.
  int direction_of(const Face &face) const
  {
    for (int d = 0; d < 3; ++d)
      if (face.kind == FaceKind::plane && norm(cross(axes_[d], face.direction)) < right_angle)
        return d;
    return -1;
  }

  void add(const Face &face, int direction)
  {
    PlateFace plate;
    plate.tag       = face.tag;
    plate.direction = direction;
    plate.level     = dot(axes_[direction], face.through);
    plate.min       = {1e300, 1e300};
    plate.max       = {-1e300, -1e300};
    for (const std::vector<int> &edges : loops_of(face.edges))
      plate.loops.push_back(loop_of(edges, plate));
    index_[face.tag] = static_cast<int>(result_.faces.size());
    result_.faces.push_back(std::move(plate));
  }

  FaceLoop loop_of(const std::vector<int> &edges, PlateFace &plate) const
  {
    const int d = plate.direction;
    FaceLoop  loop{edges, {}};
    for (const int edge : edges)
    {
      std::vector<Point2> points;
      for (const Vector3 &x : points_along(edge, model_.unit, is_line(edge) ? 1 : points_of_curves))
      {
        const Vector3 own = in(axes_, x);
        points.push_back({own[(d + 1) % 3], own[(d + 2) % 3]});
        for (int k = 0; k < 2; ++k)
        {
          plate.min[k] = std::min(plate.min[k], points.back()[k]);
          plate.max[k] = std::max(plate.max[k], points.back()[k]);
        }
      }
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        loop.sides.push_back({points[i], points[i + 1]});
    }
    return loop;
  }

  bool is_plate(int tag) const { return index_.count(tag) > 0; }

  /// Edges around an opening in a face along which some wall is at right angles to no axis.
  bool is_round_opening(const PlateFace &face, const FaceLoop &loop) const
  {
    for (const FaceLoop &other : face.loops) // the largest goes around the face
      if (&other != &loop && extent(other) > extent(loop))
        return std::any_of(loop.edges.begin(), loop.edges.end(),
                           [&](int edge)
                           {
                             const auto &faces = neighbours_.at(edge);
                             return std::any_of(faces.begin(), faces.end(),
                                                [&](const Face *f) { return !is_plate(f->tag); });
                           });
    return false;
  }

  static double extent(const FaceLoop &loop)
  {
    Point2 low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Side &side : loop.sides)
      for (int k = 0; k < 2; ++k)
      {
        low[k]  = std::min({low[k], side[0][k], side[1][k]});
        high[k] = std::max({high[k], side[0][k], side[1][k]});
      }
    return std::hypot(high[0] - low[0], high[1] - low[1]);
  }

  struct Opening
  {
    int           face;
    std::set<int> edges;
    std::set<int> walls; // tags of the adjacent faces
  };

  /// Openings of holes, two to each: they share their walls.
  void find_holes()
  {
    std::map<std::set<int>, std::vector<Opening>> openings; // by walls
    for (std::size_t f = 0; f < result_.faces.size(); ++f)
      for (const FaceLoop &loop : result_.faces[f].loops)
        if (is_round_opening(result_.faces[f], loop))
          for (Opening &opening : openings_of(static_cast<int>(f), loop))
            openings[opening.walls].push_back(std::move(opening));
    for (const auto &[walls, both] : openings)
      if (both.size() == 2 && are_parallel(walls, result_.faces[both[0].face].direction))
        add_hole(both[0], both[1]);
  }

  /// One for each solid at the face.
  std::vector<Opening> openings_of(int f, const FaceLoop &loop) const
  {
    std::vector<Opening> result;
    for (const Solid &solid : model_.solids)
    {
      const std::set<int> of_solid(solid.faces.begin(), solid.faces.end());
      if (of_solid.count(result_.faces[f].tag) == 0)
        continue;
      result.push_back({f, {loop.edges.begin(), loop.edges.end()}, {}});
      for (const int edge : loop.edges)
        for (const Face *wall : neighbours_.at(edge))
          if (wall->tag != result_.faces[f].tag && of_solid.count(wall->tag) > 0)
            result.back().walls.insert(wall->tag);
    }
    return result;
  }

  bool are_parallel(const std::set<int> &walls, int direction) const
  {
    for (const Face &face : read_)
      if (walls.count(face.tag) > 0)
        for (const Face::Sample &sample : face.samples)
          if (std::abs(dot(sample.normal, axes_[direction])) > right_angle)
            return false;
    return true;
  }

  void add_hole(const Opening &first, const Opening &second)
  {
    PlateFace &face = result_.faces[first.face], &other = result_.faces[second.face];
    if (face.direction != other.direction)
      return;
    PlateHole hole;
    hole.direction = face.direction;
    hole.from      = std::min(face.level, other.level);
    hole.to        = std::max(face.level, other.level);
    draw_section(first, face.direction, hole);
    result_.holes.push_back(std::move(hole));
    walls_.insert(first.walls.begin(), first.walls.end());
    opened_.insert(first.edges.begin(), first.edges.end());
    opened_.insert(second.edges.begin(), second.edges.end());
  }

  /// Sides in order around it, from the edges of an opening.
  void draw_section(const Opening &opening, int direction, PlateHole &hole) const
  {
    std::vector<std::pair<std::vector<Point2>, int>> curves; // and their walls
    for (const int edge : opening.edges)
    {
      curves.emplace_back();
      for (const Vector3 &x : points_along(edge, model_.unit, sides_along(edge)))
      {
        const Vector3 own = in(axes_, x);
        curves.back().first.push_back({own[(direction + 1) % 3], own[(direction + 2) % 3]});
      }
      for (const Face *wall : neighbours_.at(edge))
        if (opening.walls.count(wall->tag) > 0)
          curves.back().second = wall->tag;
    }
    hole.min = hole.max = curves.front().first.front();
    Point2 end          = hole.min;
    while (!curves.empty())
    {
      const auto apart = [&](const auto &curve)
      {
        const auto &[a, b] = std::pair(curve.first.front(), curve.first.back());
        return std::min(std::hypot(a[0] - end[0], a[1] - end[1]), std::hypot(b[0] - end[0], b[1] - end[1]));
      };
      auto  next   = std::min_element(curves.begin(), curves.end(),
                                      [&](const auto &a, const auto &b) { return apart(a) < apart(b); });
      auto &points = next->first;
      if (std::hypot(points.back()[0] - end[0], points.back()[1] - end[1]) <
          std::hypot(points.front()[0] - end[0], points.front()[1] - end[1]))
        std::reverse(points.begin(), points.end());
      for (std::size_t i = 1; i < points.size(); ++i)
      {
        hole.sides.push_back({end, points[i]});
        hole.wall.push_back(next->second);
        end = points[i];
        for (int k = 0; k < 2; ++k)
        {
          hole.min[k] = std::min(hole.min[k], end[k]);
          hole.max[k] = std::max(hole.max[k], end[k]);
        }
      }
      curves.erase(next);
    }
    hole.sides.back()[1] = hole.sides.front()[0]; // equal up to rounding
  }

  /// Number of sides for the rotation of the tangent along an edge, as of a regular polygon; even.
  int sides_along(int edge) const
  {
    if (is_line(edge))
      return 2;
    const std::vector<Vector3> x    = points_along(edge, model_.unit, points_of_curves);
    double                     turn = 0.;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
      turn += std::acos(std::clamp(dot(unit(x[i] - x[i - 1]), unit(x[i + 1] - x[i])), -1., 1.));
    constexpr int sides_of_circle = 16; // of the section of a hole: its area is 2.6 % small
    return 2 * std::max(1, static_cast<int>(std::ceil(turn / (4. * std::acos(-1.) / sides_of_circle) - 1e-3)));
  }

  /// Leaves plane walls of holes, and the edges around these, out of the faces.
  void drop_walls()
  {
    std::vector<PlateFace> kept;
    index_.clear();
    for (PlateFace &face : result_.faces)
    {
      if (walls_.count(face.tag) > 0)
        continue;
      std::vector<FaceLoop> loops;
      for (FaceLoop &loop : face.loops)
        if (opened_.count(loop.edges.front()) == 0)
          loops.push_back(std::move(loop));
      face.loops       = std::move(loops);
      index_[face.tag] = static_cast<int>(kept.size());
      kept.push_back(std::move(face));
    }
    result_.faces = std::move(kept);
  }

  const CadModel                          &model_;
  std::vector<Face>                        read_;
  Axes                                     axes_;
  std::map<int, std::vector<const Face *>> neighbours_; // of an edge
  std::map<int, int>                       index_;      // of a face by its tag
  std::set<int>                            walls_;      // of holes
  std::set<int>                            opened_;     // edges of holes
  PlateSolids                              result_;
};

} // namespace

bool PlateSolids::contains(const PlateFace &face, const Point2 &x)
{
  bool inside = false;
  for (const FaceLoop &loop : face.loops)
    for (const auto &[a, b] : loop.sides)
      if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]))
        inside = !inside;
  return inside;
}

PlateSolids plate_solids(const CadModel &model)
{
  return Reader(model).solids();
}

} // namespace gestell::fem
