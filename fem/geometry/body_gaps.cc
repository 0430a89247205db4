#include "fem/geometry/body_gaps.h"

#include "fem/geometry/cad_shape.h"
#include "fem/values/vector3.h"

#include <BRepBndLib.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Bnd_Box.hxx>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <tuple>

namespace gestell::fem
{

namespace
{

struct ShapeFace
{
  TopoDS_Shape shape;
  Bnd_Box      box;
  const Face  *face;
};

struct ShapeSolid
{
  std::vector<ShapeFace> faces;
  Bnd_Box                box;
};

Bnd_Box box_of(const TopoDS_Shape &shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  return box;
}

Vector3 vector(const gp_Pnt &p)
{
  return {p.X(), p.Y(), p.Z()};
}

/// The shapes of the solids with their outer faces, in the order of the model.
std::vector<ShapeSolid> shapes_of_solids(const CadModel &model)
{
  const TaggedShapes          tagged = tagged_shapes(model);
  std::map<int, const Face *> outer;
  for (const Face &face : model.faces)
    outer[face.tag] = &face;
  std::vector<ShapeSolid> result;
  for (const Solid &solid : model.solids)
  {
    result.push_back({{}, box_of(tagged.solids.at(solid.tag))});
    for (const int tag : solid.faces)
      if (const auto face = outer.find(tag); face != outer.end())
      {
        const TopoDS_Shape &shape = tagged.faces.at(tag);
        result.back().faces.push_back({shape, box_of(shape), face->second});
      }
  }
  return result;
}

/// |cosine| between a direction and the normal of a face at a point.
double facing(const Face &face, const Vector3 &at, const Vector3 &direction)
{
  if (face.kind == FaceKind::plane)
    return std::abs(dot(face.direction, direction));
  if (face.kind != FaceKind::cylinder)
    return 0.5;
  const Vector3 from_axis = at - face.through;
  const Vector3 radial    = from_axis - dot(from_axis, face.direction) * face.direction;
  return std::abs(dot(radial, direction)) / norm(radial);
}

/// The two nearest faces of two solids; of several pairs at the same distance the one whose faces point to each other.
BodyGap gap_between(const ShapeSolid &a, const ShapeSolid &b, const CadModel &model)
{
  std::vector<std::tuple<double, const ShapeFace *, const ShapeFace *>> pairs;
  for (const ShapeFace &of_a : a.faces)
    for (const ShapeFace &of_b : b.faces)
      pairs.emplace_back(of_a.box.Distance(of_b.box), &of_a, &of_b);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto &x, const auto &y) { return std::get<0>(x) < std::get<0>(y); });

  BodyGap best;
  best.distance  = INFINITY;
  double turned  = -1.;
  int    n_tried = 0;
  for (const auto &[apart, of_a, of_b] : pairs)
  {
    // [m]: distances that differ by less are equal, as CAD programs agree to 1e-7 m
    constexpr double same      = 1e-9;
    constexpr int    most_here = 400; // pairs of faces tried once a distance is found: equal boxes are common in grids
    if (apart * model.unit > best.distance + same || (best.distance < INFINITY && ++n_tried > most_here))
      break;
    BRepExtrema_DistShapeShape extrema(of_a->shape, of_b->shape);
    if (!extrema.IsDone() || extrema.NbSolution() == 0)
      continue;
    const double distance = model.unit * extrema.Value();
    if (distance > best.distance + same)
      continue;
    const Vector3 from  = model.unit * vector(extrema.PointOnShape1(1)),
                  to    = model.unit * vector(extrema.PointOnShape2(1));
    const Face  &face_a = *of_a->face, &face_b = *of_b->face;
    const double opposite =
        distance > same ? facing(face_a, from, unit(to - from)) + facing(face_b, to, unit(to - from)) : 0.;
    if (distance > best.distance - same && opposite <= turned)
      continue;
    turned        = opposite;
    best.distance = std::min(distance, best.distance);
    best.at       = 0.5 * (from + to);
    best.face_a   = describe(face_a);
    best.face_b   = describe(face_b);
  }
  return best;
}

/// Pairs of solids of different bodies, nearest first; at first the distance of their boxes.
struct Candidate
{
  double  distance;
  bool    exact;
  BodyGap gap;

  bool operator<(const Candidate &other) const { return distance > other.distance; } // for the queue: smallest on top
};

} // namespace

std::vector<BodyGap> nearest_gaps(const CadModel &model, const std::vector<int> &body)
{
  const std::vector<ShapeSolid>  shapes = shapes_of_solids(model);
  std::priority_queue<Candidate> queue;
  for (std::size_t i = 0; i < model.solids.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (body[i] != body[j] && !shapes[i].faces.empty() && !shapes[j].faces.empty())
      {
        Candidate candidate{model.unit * shapes[j].box.Distance(shapes[i].box), false, {}};
        candidate.gap.solid_a = static_cast<int>(j);
        candidate.gap.solid_b = static_cast<int>(i);
        queue.push(candidate);
      }

  std::vector<int>     joined = body;
  std::vector<BodyGap> gaps;
  while (!queue.empty())
  {
    Candidate nearest = queue.top();
    queue.pop();
    const int a = nearest.gap.solid_a, b = nearest.gap.solid_b;
    if (joined[a] == joined[b])
      continue;
    if (!nearest.exact)
    {
      nearest.gap         = gap_between(shapes[a], shapes[b], model);
      nearest.gap.solid_a = a;
      nearest.gap.solid_b = b;
      nearest.distance    = nearest.gap.distance;
      nearest.exact       = true;
      queue.push(nearest);
      continue;
    }
    gaps.push_back(nearest.gap);
    const int into = joined[a], from = joined[b];
    std::replace(joined.begin(), joined.end(), from, into);
  }
  return gaps;
}

} // namespace gestell::fem
