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

constexpr double right_angle = 1e-5; // [rad] by which normals may differ from an axis

std::vector<Face> faces_of(const std::vector<Solid> &solids, const std::vector<Face> &all)
{
  std::set<int> tags;
  for (const Solid &solid : solids)
    tags.insert(solid.faces.begin(), solid.faces.end());
  std::vector<Face> faces;
  for (const Face &face : all)
    if (tags.count(face.tag) > 0)
      faces.push_back(face);
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

double extent_of(const FaceLoop &loop)
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

class Reader
{
public:
  Reader(const std::vector<Solid> &solids, const std::vector<Face> &all, double unit)
      : solids_(solids), unit_(unit), read_(faces_of(solids, all)), axes_(main_axes(read_))
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
        throw NotSwept(describe(face) + ", is neither perpendicular to the others nor the wall of a through hole");
    for (const Solid &solid : solids_)
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
    index_[face.tag] = static_cast<int>(result_.faces.size());
    result_.faces.push_back(plate_face(face, {axes_, direction, unit_}));
  }

  bool is_plate(int tag) const { return index_.count(tag) > 0; }

  /// Edges around an opening in a face along which some wall is at right angles to no axis.
  bool is_round_opening(const PlateFace &face, const FaceLoop &loop) const
  {
    for (const FaceLoop &other : face.loops) // the largest goes around the face
      if (&other != &loop && extent_of(other) > extent_of(loop))
        return std::any_of(loop.edges.begin(), loop.edges.end(),
                           [&](int edge)
                           {
                             const auto &faces = neighbours_.at(edge);
                             return std::any_of(faces.begin(), faces.end(),
                                                [&](const Face *f) { return !is_plate(f->tag); });
                           });
    return false;
  }

  struct Opening
  {
    int           face, solid;
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
    for (std::size_t i = 0; i < solids_.size(); ++i)
    {
      const std::set<int> of_solid(solids_[i].faces.begin(), solids_[i].faces.end());
      if (of_solid.count(result_.faces[f].tag) == 0)
        continue;
      result.push_back({f, static_cast<int>(i), {loop.edges.begin(), loop.edges.end()}, {}});
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
    const Outline section = outline_of({first.edges.begin(), first.edges.end()}, {axes_, face.direction, unit_});
    PlateHole     hole{face.direction,
                   std::min(face.level, other.level),
                   std::max(face.level, other.level),
                   section.sides,
                   {},
                   section.min,
                   section.max,
                   first.solid};
    for (const int edge : section.edge)
      hole.wall.push_back(wall_at(edge, first));
    result_.holes.push_back(std::move(hole));
    walls_.insert(first.walls.begin(), first.walls.end());
    opened_.insert(first.edges.begin(), first.edges.end());
    opened_.insert(second.edges.begin(), second.edges.end());
  }

  int wall_at(int edge, const Opening &opening) const
  {
    for (const Face *wall : neighbours_.at(edge))
      if (opening.walls.count(wall->tag) > 0)
        return wall->tag;
    return 0;
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

  const std::vector<Solid>                &solids_;
  double                                   unit_;
  std::vector<Face>                        read_;
  Axes                                     axes_;
  std::map<int, std::vector<const Face *>> neighbours_; // of an edge
  std::map<int, int>                       index_;      // of a face by its tag
  std::set<int>                            walls_;      // of holes
  std::set<int>                            opened_;     // edges of holes
  PlateSolids                              result_;
};

} // namespace

const FaceLoop *outer_loop(const PlateFace &face)
{
  const FaceLoop *outer = nullptr;
  for (const FaceLoop &loop : face.loops)
    if (!outer || extent_of(loop) > extent_of(*outer))
      outer = &loop;
  return outer;
}

bool PlateSolids::contains(const PlateFace &face, const Point2 &x)
{
  bool inside = false;
  for (const FaceLoop &loop : face.loops)
    inside = inside != is_inside(loop.sides, x);
  return inside;
}

std::vector<Face> all_faces(const CadModel &model)
{
  std::vector<Face> faces = model.faces;
  for (Face &face : inner_faces(model.unit, model.diagonal()))
    faces.push_back(std::move(face));
  return faces;
}

PlateFace plate_face(const Face &face, const DrawingPlane &plane)
{
  PlateFace plate;
  plate.tag       = face.tag;
  plate.direction = plane.direction;
  plate.level     = dot(plane.axes[plane.direction], face.through);
  plate.min       = {1e300, 1e300};
  plate.max       = {-1e300, -1e300};
  for (const std::vector<int> &edges : loops_of(face.edges))
  {
    plate.loops.push_back(face_loop(edges, plane));
    for (const Side &side : plate.loops.back().sides)
      for (const Point2 &x : side)
        for (int k = 0; k < 2; ++k)
        {
          plate.min[k] = std::min(plate.min[k], x[k]);
          plate.max[k] = std::max(plate.max[k], x[k]);
        }
  }
  return plate;
}

PlateSolids plate_solids(const std::vector<Solid> &solids, const std::vector<Face> &all, double unit)
{
  return Reader(solids, all, unit).solids();
}

} // namespace gestell::fem
