#include "apps/output/mechanism_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

constexpr double pi          = 3.14159265358979323846;
constexpr int    n_rim       = 36;   ///< corners of a disc
constexpr double disc_width  = 0.25; ///< of its radius
constexpr double rod_breadth = 0.08; ///< of its length

Vector3d vector(const std::array<double, 3> &x)
{
  return {x[0], x[1], x[2]};
}

/// Unit vector across `axis`, as near to `wish` as may be.
Vector3d across(const Vector3d &axis, const Vector3d &wish)
{
  const Vector3d part = wish - axis.dot(wish) * axis;
  return part.norm() > 1e-6 ? part.normalized() : axis.unitOrthogonal();
}

/// Adds a box about `centre` with half edges a, b, c (a right-handed frame).
void add_box(Shape &shape, const Vector3d &centre, const Vector3d &a, const Vector3d &b, const Vector3d &c)
{
  const int first = static_cast<int>(shape.points.size());
  for (const double k : {-1., 1.})
    for (const auto &[i, j] : {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
      shape.points.push_back(centre + i * a + j * b + k * c);
  const auto quad = [&](int p, int q, int r, int s)
  {
    shape.triangles.push_back({first + p, first + q, first + r});
    shape.triangles.push_back({first + p, first + r, first + s});
  };
  quad(3, 2, 1, 0);
  quad(4, 5, 6, 7);
  for (int i = 0; i < 4; ++i)
    quad(i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4);
}

/// Adds a disc about `centre`; e1, e2, axis are a right-handed frame of unit vectors.
void add_disc(Shape &shape, const Vector3d &centre, const Vector3d &e1, const Vector3d &e2, const Vector3d &axis,
              double radius)
{
  const int      first = static_cast<int>(shape.points.size());
  const Vector3d side  = 0.5 * disc_width * radius * axis;
  for (int i = 0; i < n_rim; ++i)
  {
    const double   angle = 2. * pi * i / n_rim;
    const Vector3d rim   = centre + radius * (std::cos(angle) * e1 + std::sin(angle) * e2);
    shape.points.push_back(rim - side);
    shape.points.push_back(rim + side);
  }
  shape.points.push_back(centre - side);
  shape.points.push_back(centre + side);
  for (int i = 0; i < n_rim; ++i)
  {
    const int here = first + 2 * i, next = first + 2 * ((i + 1) % n_rim), hub = first + 2 * n_rim;
    shape.triangles.push_back({here, next, next + 1});
    shape.triangles.push_back({here, next + 1, here + 1});
    shape.triangles.push_back({hub, next, here});
    shape.triangles.push_back({hub + 1, here + 1, next + 1});
  }
}

const coupling::Body *find(const Scenery &scenery, const std::string &name)
{
  const auto body = std::find_if(scenery.bodies.begin(), scenery.bodies.end(),
                                 [&](const coupling::Body &b) { return b.name == name; });
  return body != scenery.bodies.end() ? &*body : nullptr;
}

/// Where a rotor is and how it stands: pin direction and its perpendicular for the angle in q.
struct RotorPose
{
  Vector3d axis, pin, ahead;

  RotorPose(const Scenery &scenery, const coupling::Body &rotor, const Eigen::VectorXd &q)
      : axis(vector(rotor.axis).normalized())
  {
    Vector3d top = Vector3d::UnitZ();
    for (const coupling::DrawnRod &rod : scenery.rods)
      if (rod.crank == rotor.name)
        if (const coupling::Body *slider = find(scenery, rod.slider))
          top = -vector(slider->axis);
    const Vector3d zero = across(axis, axis.cross(top).norm() > 1e-6 ? top : Vector3d::UnitX());
    const double   phi  = q(rotor.coordinate);
    pin                 = std::cos(phi) * zero + std::sin(phi) * axis.cross(zero);
    ahead               = axis.cross(pin);
  }
};

/// A slider's way along its axis, split into the ideal part and the rest with which it moves sideways.
struct SliderPose
{
  Vector3d axis;
  double   ideal; ///< [m]
  Vector3d displacement;

  SliderPose(const Scenery &scenery, const coupling::Body &slider, const Eigen::VectorXd &q)
      : axis(vector(slider.axis).normalized())
  {
    const double way = q(slider.coordinate);
    ideal            = way;
    for (const coupling::DrawnRod &rod : scenery.rods)
      if (rod.slider == slider.name)
        if (const coupling::Body *crank = find(scenery, rod.crank))
        {
          const double r = rod.crank_radius, l = rod.length, phi = q(crank->coordinate);
          ideal = -r * std::cos(phi) + std::sqrt(std::max(0., l * l - std::pow(r * std::sin(phi), 2))) - (l - r);
        }
    const Vector3d moved = translation(slider.marker, q);
    displacement         = (way - ideal) * axis + moved - axis.dot(moved) * axis;
  }
};

Shape rotor_shape(const Scenery &scenery, const coupling::Body &rotor, const Eigen::VectorXd &q)
{
  const RotorPose pose(scenery, rotor, q);
  const Vector3d  centre = vector(rotor.position);
  const double    r      = rotor.radius;

  Shape shape;
  shape.name = rotor.name;
  add_disc(shape, centre, pose.pin, pose.ahead, pose.axis, r);
  // The rib stands out on both sides of the disc and shows the angle.
  add_box(shape, centre + 0.5 * r * pose.pin, 0.5 * r * pose.pin, 0.09 * r * pose.ahead,
          disc_width * r * pose.axis);
  shape.displacement.assign(shape.points.size(), translation(rotor.marker, q));
  return shape;
}

Shape slider_shape(const Scenery &scenery, const coupling::Body &slider, const Eigen::VectorXd &q)
{
  const SliderPose pose(scenery, slider, q);
  Shape            shape;
  shape.name = slider.name;
  add_box(shape, vector(slider.position) + pose.ideal * pose.axis, 0.5 * slider.size[0] * Vector3d::UnitX(),
          0.5 * slider.size[1] * Vector3d::UnitY(), 0.5 * slider.size[2] * Vector3d::UnitZ());
  shape.displacement.assign(shape.points.size(), pose.displacement);
  return shape;
}

Shape rod_shape(const Scenery &scenery, const coupling::DrawnRod &rod, const coupling::Body &crank,
                const coupling::Body &slider, const Eigen::VectorXd &q)
{
  const RotorPose  turned(scenery, crank, q);
  const SliderPose slid(scenery, slider, q);
  const Vector3d   centre    = vector(crank.position);
  const Vector3d   big_end   = centre + rod.crank_radius * turned.pin;
  const Vector3d   small_end = centre + (rod.length - rod.crank_radius + slid.ideal) * slid.axis;
  const Vector3d   half = 0.5 * (small_end - big_end), along = half.normalized();
  const Vector3d   side = across(along, turned.axis), front = along.cross(side);
  const double     breadth = 0.5 * rod_breadth * rod.length;

  Shape shape;
  shape.name = rod.name;
  add_box(shape, big_end + half, half, breadth * side, breadth * front);
  const Vector3d at_crank = translation(crank.marker, q);
  for (const Vector3d &point : shape.points)
  {
    const bool is_small_end = (point - big_end).dot(half) > half.squaredNorm();
    shape.displacement.push_back(is_small_end ? slid.displacement : at_crank);
  }
  return shape;
}

} // namespace

std::vector<Shape> mechanism_shapes(const Scenery &scenery, const Eigen::VectorXd &q)
{
  std::vector<Shape> shapes;
  for (const coupling::Body &body : scenery.bodies)
    if (body.kind == coupling::BodyKind::rotor && body.radius > 0.)
      shapes.push_back(rotor_shape(scenery, body, q));
    else if (body.kind == coupling::BodyKind::slider && vector(body.size).minCoeff() > 0.)
      shapes.push_back(slider_shape(scenery, body, q));
  for (const coupling::DrawnRod &rod : scenery.rods)
  {
    const coupling::Body *crank = find(scenery, rod.crank), *slider = find(scenery, rod.slider);
    if (crank != nullptr && slider != nullptr && rod.length > rod.crank_radius)
      shapes.push_back(rod_shape(scenery, rod, *crank, *slider, q));
  }
  return shapes;
}

} // namespace gestell::apps
