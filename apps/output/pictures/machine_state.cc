#include "apps/output/pictures/machine_state.h"

#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/pictures/scenery_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

/// Gives the points of each end of a bar their mean displacement.
void move_ends(const std::vector<Vector3d> &points, std::vector<Vector3d> &displacement)
{
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d &x : points)
    middle += x / static_cast<double>(points.size());
  Vector3d along = Vector3d::Zero(); // the point farthest from the middle is at an end
  for (const Vector3d &x : points)
    along = (x - middle).norm() > along.norm() ? x - middle : along;
  std::array<Vector3d, 2> sum = {Vector3d::Zero(), Vector3d::Zero()};
  std::array<int, 2>      n   = {0, 0};
  const auto              end = [&](std::size_t j) { return (points[j] - middle).dot(along) > 0. ? 1u : 0u; };
  for (std::size_t j = 0; j < points.size(); ++j)
  {
    sum[end(j)] += displacement[j];
    ++n[end(j)];
  }
  for (std::size_t j = 0; j < points.size(); ++j)
    displacement[j] = sum[end(j)] / n[end(j)];
}

/// The largest of 1, 2, 5, 10, 20, ... that is not above x > 0, or below one of 0.5, 0.2, ...
double round_number(double x)
{
  const double power = std::pow(10., std::floor(std::log10(x) + 1e-12));
  for (const double k : {5., 2.})
    if (x >= k * power * (1. - 1e-9))
      return k * power;
  return power;
}

} // namespace

double MachineState::size() const
{
  std::vector<Vector3d> points = skin.points;
  for (const Shape &shape : shapes)
    points.insert(points.end(), shape.points.begin(), shape.points.end());
  return Skin{points, {}, {}}.size();
}

double MachineState::largest_displacement() const
{
  double largest = skin.largest_displacement();
  if (skin.points.empty())
    for (const Shape &shape : shapes)
      for (const Vector3d &u : shape.displacement)
        largest = std::max(largest, u.norm());
  return largest;
}

MachineState machine_state(const Scenery &scenery, const Eigen::VectorXd &q)
{
  return {skin_of(scenery, q), mechanism_shapes(scenery, q)};
}

std::vector<std::vector<Vector3d>> differences(const Scenery &scenery, const std::vector<Shape> &before,
                                               const std::vector<Shape> &after)
{
  std::vector<std::vector<Vector3d>> moved;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    moved.emplace_back();
    for (std::size_t j = 0; j < before[i].points.size(); ++j)
      moved.back().push_back(after[i].points[j] + after[i].displacement[j] - before[i].points[j] -
                             before[i].displacement[j]);
    const auto bar = std::find_if(scenery.bars.begin(), scenery.bars.end(),
                                  [&](const coupling::DrawnBar &one) { return one.name == before[i].name; });
    if (bar != scenery.bars.end())
      move_ends(before[i].points, moved.back());
  }
  return moved;
}

std::vector<std::vector<Vector3d>> body_mode(const Scenery &scenery, const Eigen::VectorXd &q0,
                                             const Eigen::VectorXd &shape)
{
  // Central differences: bodies on circles miss by the square of the step, 1e-12; digits lose 1e-10 of it.
  constexpr double little = 1e-6;
  const double     most   = shape.size() > 0 ? shape.cwiseAbs().maxCoeff() : 0.;
  const double     step   = most > 0. ? little * scenery.size() / most : 1.;
  auto             moved =
      differences(scenery, mechanism_shapes(scenery, q0 - step * shape), mechanism_shapes(scenery, q0 + step * shape));
  for (std::vector<Vector3d> &body : moved)
    for (Vector3d &u : body)
      u /= 2. * step;
  return moved;
}

double shown_enlargement(const MachineState &state)
{
  const double largest = state.largest_displacement(), size = state.size();
  return largest > 0. && size > 0. ? round_number(shown_size * size / largest) : 0.;
}

} // namespace gestell::apps
