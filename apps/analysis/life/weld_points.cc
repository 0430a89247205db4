#include "apps/analysis/life/weld_points.h"

#include "fem/values/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;
using Triangle = std::array<int, 3>;

Vector3d vector_of(const fem::Vector3 &x)
{
  return {x[0], x[1], x[2]};
}

bool lies_on(const fem::SurfaceSelector &surface, const Vector3d &x, double tolerance)
{
  if (surface.plane &&
      std::abs(vector_of(surface.plane->normal).normalized().dot(x - vector_of(surface.plane->through))) > tolerance)
    return false;
  if (surface.cylinder)
  {
    const Vector3d axis = vector_of(surface.cylinder->axis).normalized();
    const double   r    = axis.cross(x - vector_of(surface.cylinder->through)).norm();
    if (std::abs(r - surface.cylinder->radius) > tolerance)
      return false;
  }
  if (surface.box)
    for (int d = 0; d < 3; ++d)
      if (x[d] < surface.box->min[std::size_t(d)] - tolerance || x[d] > surface.box->max[std::size_t(d)] + tolerance)
        return false;
  return true;
}

std::vector<char> points_on(const fem::SurfaceSelector &surface, const LifeSkin &skin)
{
  constexpr double  share     = 1e-4; // of the diagonal, as that of selectors
  const double      tolerance = surface.tolerance.value_or(share * skin.size);
  std::vector<char> on;
  for (const Vector3d &x : skin.position)
    on.push_back(lies_on(surface, x, tolerance));
  return on;
}

/// Triangles with all corners on a surface.
std::vector<Triangle> triangles_on(const std::vector<char> &on, const LifeSkin &skin)
{
  std::vector<Triangle> found;
  for (const Triangle &triangle : skin.triangles)
    if (std::all_of(triangle.begin(), triangle.end(), [&](int i) { return on[std::size_t(i)]; }))
      found.push_back(triangle);
  return found;
}

/// Mean normal and mean offset of the centroids of the triangles at a point; none: it has no triangle there.
struct Corner
{
  Vector3d normal = Vector3d::Zero(), inwards = Vector3d::Zero();
};
std::optional<Corner> corner_at(int point, const std::vector<Triangle> &triangles, const LifeSkin &skin)
{
  Corner corner;
  for (const Triangle &triangle : triangles)
    if (std::find(triangle.begin(), triangle.end(), point) != triangle.end())
    {
      corner.normal += skin.normal(triangle);
      for (const int i : triangle)
        corner.inwards += skin.position[std::size_t(i)] - skin.position[std::size_t(point)];
    }
  if (corner.normal.norm() == 0.)
    return {};
  corner.normal.normalize();
  return corner;
}

/// A stress as a weighted sum of those at points.
using Weights = std::vector<std::pair<int, double>>;

/// Adds the point of a triangle below y, and returns the triangle; null: none is there.
const Triangle *add_stress_at(const Vector3d &y, double factor, double nearest, const std::vector<Triangle> &triangles,
                              const LifeSkin &skin, Weights &weights)
{
  constexpr double rounding = 1e-6; // of barycentric coordinates on a common side
  for (const Triangle &triangle : triangles)
  {
    const Vector3d  n = skin.normal(triangle);
    const Vector3d &a = skin.position[std::size_t(triangle[0])];
    if (std::abs(n.dot(y - a)) > nearest * n.norm())
      continue;
    const Vector3d ab = skin.position[std::size_t(triangle[1])] - a, ac = skin.position[std::size_t(triangle[2])] - a;
    const double   v = (y - a).cross(ac).dot(n) / n.squaredNorm(), w = ab.cross(y - a).dot(n) / n.squaredNorm();
    if (std::min({v, w, 1. - v - w}) < -rounding)
      continue;
    weights.insert(weights.end(),
                   {{triangle[0], factor * (1. - v - w)}, {triangle[1], factor * v}, {triangle[2], factor * w}});
    return &triangle;
  }
  return nullptr;
}

/// Its length in a direction.
double extent(const Triangle &triangle, const Vector3d &direction, const LifeSkin &skin)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const int i : triangle)
  {
    const double x = direction.dot(skin.position[std::size_t(i)]);
    low = std::min(low, x), high = std::max(high, x);
  }
  return high - low;
}

/// The smallest distance of the extrapolation points from the line and from each other, in t.
double resolution(const std::vector<double> &distances)
{
  double smallest = distances.front();
  for (std::size_t k = 1; k < distances.size(); ++k)
    smallest = std::min(smallest, distances[k] - distances[k - 1]);
  return smallest;
}

double factor_at_zero(const std::vector<double> &distances, std::size_t k)
{
  double factor = 1.;
  for (std::size_t j = 0; j < distances.size(); ++j)
    if (j != k)
      factor *= distances[j] / (distances[j] - distances[k]);
  return factor;
}

struct WeldPoint
{
  Weights           weights;
  int               point;
  SurfaceDirections directions;
};

WeldPoints points_of(const std::vector<WeldPoint> &chosen, const coupling::ReducedStress &stress, const LifeSkin &skin)
{
  WeldPoints found;
  found.stress.mean = Eigen::MatrixXf::Zero(6 * Eigen::Index(chosen.size()), stress.mean.cols());
  for (const WeldPoint &one : chosen)
  {
    auto rows = found.stress.mean.middleRows<6>(6 * Eigen::Index(found.skin.size()));
    for (const auto &[i, weight] : one.weights)
      rows += float(weight) * stress.mean.middleRows<6>(6 * Eigen::Index(i));
    found.stress.point.push_back(int(found.skin.size()));
    found.stress.nearby.push_back(-1);
    found.position.push_back(skin.position[std::size_t(one.point)]);
    found.directions.push_back(one.directions);
    const auto less = [](const auto &a, const auto &b) { return std::abs(a.second) < std::abs(b.second); };
    found.skin.push_back(std::max_element(one.weights.begin(), one.weights.end(), less)->first);
  }
  return found;
}

/// The direction in the surface; none if it is normal to it.
std::optional<Vector3d> in_surface(const Vector3d &direction, const Vector3d &normal)
{
  constexpr double least = 0.1; // sine of 6 degrees: what remains of a direction that is meant to be the normal
  const Vector3d   rest  = direction.normalized() - normal.dot(direction.normalized()) * normal;
  return rest.norm() > least ? std::optional<Vector3d>(rest.normalized()) : std::nullopt;
}

[[noreturn]] void refuse_normal_direction(const WeldRequest &weld)
{
  throw std::invalid_argument(weld.place + ": the 'direction' of the weld '" + weld.name + "' is normal to '" +
                              weld.surfaces.front() + "'; give one in this surface, or leave it out");
}

SurfaceDirections across(const Vector3d &normal, const Vector3d &direction)
{
  return {normal, normal.cross(direction).normalized()};
}

std::string position_text(const Vector3d &x)
{
  return "(" + short_text(x[0]) + " " + short_text(x[1]) + " " + short_text(x[2]) + ")";
}

/// Where a weld is not assessed.
struct Omitted
{
  std::size_t n   = 0;
  Vector3d    low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;

  void add(const Vector3d &x)
  {
    ++n;
    low = low.cwiseMin(x), high = high.cwiseMax(x);
  }
  std::string words(const WeldRequest &weld, std::size_t assessed) const
  {
    return "life: the weld '" + weld.name + "' is not assessed at " + std::to_string(n) + " of " +
           count_text(n + assessed, "point") + ", between " + position_text(low) + " and " + position_text(high) + ": ";
  }
};

std::string of_normal_direction(const WeldRequest &weld, const Omitted &there, std::size_t assessed)
{
  return there.words(weld, assessed) + "its 'direction' is normal to '" + weld.surfaces.front() +
         "' there; assess this part as a weld of its own";
}

std::vector<WeldPoint> area(const WeldRequest &weld, const std::vector<char> &on, const coupling::ReducedStress &stress,
                            const LifeSkin &skin, std::vector<std::string> &doubts)
{
  std::vector<WeldPoint> chosen;
  Omitted                normal_to; // the direction
  for (std::size_t i = 0; i < on.size(); ++i)
    if (const Vector3d &normal = skin.directions[i].normal; on[i] && stress.nearby[i] < 0)
    {
      if (weld.direction && normal.isZero()) // an edge
        continue;
      const auto direction = weld.direction ? in_surface(vector_of(*weld.direction), normal) : std::nullopt;
      if (weld.direction && !direction)
        normal_to.add(skin.position[i]);
      if (!weld.direction || direction)
        chosen.push_back({{{int(i), 1.}}, int(i), direction ? across(normal, *direction) : skin.directions[i]});
    }
  if (chosen.empty() && normal_to.n > 0)
    refuse_normal_direction(weld);
  if (normal_to.n > 0)
    doubts.push_back(of_normal_direction(weld, normal_to, chosen.size()));
  return chosen;
}

std::string in_mm(double length)
{
  return short_text(1e3 * length, 3) + " mm";
}

std::vector<std::string> doubts_of(const WeldRequest &weld, double largest, bool reentrant, const Omitted &omitted,
                                   std::size_t assessed)
{
  std::vector<std::string> doubts;
  const std::string        name    = "life: the weld '" + weld.name + "' ";
  const double             allowed = weld.thickness > 0. ? resolution(weld.distances) * weld.thickness : 0.;
  constexpr double         uneven  = 1.25; // meshers exceed the size that was asked for by so much
  if (weld.thickness == 0. && reentrant)
    doubts.push_back(name + "uses the stress in a re-entrant corner, which is singular, so no mesh resolves it; give "
                            "its 'thickness' for the hot-spot stress");
  if (weld.thickness > 0. && largest > uneven * allowed)
    doubts.push_back(name + "is extrapolated from elements of " + in_mm(largest) +
                     ", too large for its distances; use elements of " + in_mm(allowed) +
                     " there, or larger distances (IIW)");
  if (omitted.n > 0 && assessed > 0)
    doubts.push_back(omitted.words(weld, assessed) + "'" + weld.surfaces.front() + "' is narrower there than " +
                     in_mm(weld.distances.back() * weld.thickness) +
                     "; give smaller 'distances', or assess this part as a weld of its own");
  return doubts;
}

std::vector<WeldPoint> line(const WeldRequest &weld, const std::vector<std::vector<char>> &on, const LifeSkin &skin,
                            std::vector<std::string> &doubts)
{
  double                 largest = 0.;
  Omitted                omitted, normal_to; // too narrow; the direction
  bool                   reentrant = false;
  std::vector<WeldPoint> chosen;
  const auto             first = triangles_on(on[0], skin), second = triangles_on(on[1], skin);
  for (std::size_t i = 0; i < on[0].size(); ++i)
  {
    const auto here  = on[0][i] && on[1][i] ? corner_at(int(i), first, skin) : std::nullopt;
    const auto there = here ? corner_at(int(i), second, skin) : std::nullopt;
    if (!there)
      continue;
    Vector3d away = here->normal.cross(there->normal).cross(here->normal).normalized(); // from the line
    if (away.dot(here->inwards) < 0.)
      away = -away;
    Vector3d direction = away;
    if (weld.direction)
    {
      const auto given = in_surface(vector_of(*weld.direction), here->normal);
      if (!given)
      {
        normal_to.add(skin.position[i]);
        continue;
      }
      direction = *given;
    }
    constexpr double corner = 0.1; // sine of 6 degrees: a chord of a curved surface is not a corner
    reentrant               = reentrant || here->normal.dot(there->inwards.normalized()) > corner;
    Weights weights{{int(i), 1.}};
    if (weld.thickness > 0.)
    {
      weights.clear();
      double across_here = 0.;
      bool   reaches     = true;
      for (std::size_t k = 0; k < weld.distances.size() && reaches; ++k)
      {
        const Triangle *triangle =
            add_stress_at(skin.position[i] + weld.distances[k] * weld.thickness * away,
                          factor_at_zero(weld.distances, k), 0.5 * weld.thickness, first, skin, weights);
        reaches     = triangle != nullptr;
        across_here = reaches ? std::max(across_here, extent(*triangle, away, skin)) : across_here;
      }
      if (!reaches)
      {
        omitted.add(skin.position[i]);
        continue;
      }
      largest = std::max(largest, across_here);
    }
    chosen.push_back({std::move(weights), int(i), across(here->normal, direction)});
  }
  if (chosen.empty() && normal_to.n > 0)
    refuse_normal_direction(weld);
  doubts = doubts_of(weld, largest, reentrant, omitted, chosen.size());
  if (normal_to.n > 0)
    doubts.push_back(of_normal_direction(weld, normal_to, chosen.size()));
  return chosen;
}

/// At least one point of the first surface is not next to a rigid one.
void require_valid_stresses(const WeldRequest &weld, const std::vector<char> &on, const coupling::ReducedStress &stress)
{
  int nearby = -1;
  for (std::size_t i = 0; i < on.size(); ++i)
    if (on[i] && (nearby = stress.nearby[i]) < 0)
      return;
  if (nearby >= 0)
    throw std::invalid_argument(weld.place + ": all points of '" + weld.surfaces.front() + "', the first surface of " +
                                "the weld '" + weld.name + "', are at " + stress.rigid[std::size_t(nearby)] +
                                ", a rigid surface without valid stresses; name the other surface first");
}

} // namespace

WeldPoints weld_points(const WeldRequest &weld, const std::map<std::string, fem::SurfaceSelector> &surfaces,
                       const coupling::ReducedStress &stress, const LifeSkin &skin)
{
  std::vector<std::vector<char>> on;
  std::string                    counts;
  for (const std::string &name : weld.surfaces)
  {
    on.push_back(points_on(surfaces.at(name), skin));
    counts += (counts.empty() ? "'" : ", '") + name + "' has " +
              count_text(std::size_t(std::count(on.back().begin(), on.back().end(), 1)), "point");
  }
  std::vector<std::string>     doubts;
  const std::vector<WeldPoint> chosen =
      on.size() == 1 ? area(weld, on[0], stress, skin, doubts) : line(weld, on, skin, doubts);
  if (chosen.empty())
    throw std::invalid_argument(
        weld.place + ": the weld '" + weld.name + "' matches no point of the skin (" + counts + "); " +
        (on.size() == 1        ? "name a surface that is not rigid, with points away from its edges"
         : weld.thickness > 0. ? "name two surfaces that meet, the first of which extends " +
                                     short_text(1e3 * weld.distances.back() * weld.thickness) + " mm beyond the line"
                               : "name two surfaces that meet"));
  if (on.size() == 2)
    require_valid_stresses(weld, on.front(), stress);
  WeldPoints points = points_of(chosen, stress, skin);
  points.doubts     = std::move(doubts);
  return points;
}

} // namespace gestell::apps
