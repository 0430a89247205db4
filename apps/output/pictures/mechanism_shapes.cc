#include "apps/output/pictures/mechanism_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

// parts of the machine's size
constexpr double plate_radius = 0.012, bar_radius = 0.005, point_radius = 0.02, bar_of_body = 0.01;

/// Roundness of what is drawn: of many bodies each has fewer corners, so that pictures and page stay light.
struct Roundness
{
  int sphere = 8, bar = 12; ///< bands from pole to pole; corners

  explicit Roundness(std::size_t n_drawn)
  {
    if (n_drawn > 300)
      sphere = 2, bar = 4;
    else if (n_drawn > 60)
      sphere = 4, bar = 6;
  }
};

Vector3d vector(const std::array<double, 3> &x)
{
  return {x[0], x[1], x[2]};
}

const coupling::Body *find(const Scenery &scenery, const std::string &name)
{
  const auto body = std::find_if(scenery.bodies.begin(), scenery.bodies.end(),
                                 [&](const coupling::Body &b) { return b.name == name; });
  return body != scenery.bodies.end() ? &*body : nullptr;
}

/// Separates the motion of the bodies from that of the frame, q = bodies + frame.
struct Split
{
  Eigen::VectorXd bodies, frame;

  Split(const Scenery &scenery, const Eigen::VectorXd &q) : bodies(q), frame(q)
  {
    bodies.head(scenery.n_frame).setZero();
    frame.tail(q.size() - scenery.n_frame).setZero();
  }
};

/// Position and orientation of a rotor: pin direction and its perpendicular for the angle in q.
struct RotorPose
{
  Vector3d axis, pin, ahead;
  double   reach; ///< [m] of the pin, at least the radius

  RotorPose(const Scenery &scenery, const coupling::Body &rotor, const Eigen::VectorXd &q)
      : axis(vector(rotor.axis).normalized()), reach(rotor.radius)
  {
    Vector3d top = Vector3d::UnitZ();
    for (const coupling::DrawnRod &rod : scenery.rods)
      if (rod.crank == rotor.name)
        if (const coupling::Body *slider = find(scenery, rod.slider))
          top = -vector(slider->axis);
    for (const auto &x : rotor.points)
      if (const Vector3d arm = vector(x) - vector(rotor.position); axis.cross(arm).norm() > 1e-6 * rotor.radius)
      {
        top   = arm;
        reach = std::max(reach, axis.cross(arm).norm());
        break;
      }
    const Vector3d zero = across(axis, axis.cross(top).norm() > 1e-6 ? top : Vector3d::UnitX());
    const double   phi  = q(rotor.coordinate);
    pin                 = std::cos(phi) * zero + std::sin(phi) * axis.cross(zero);
    ahead               = axis.cross(pin);
  }
};

/// The motion of a slider along its axis (ideal part), and its lateral motion.
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
  const Split     split(scenery, q);
  const Vector3d  centre = vector(rotor.position) + translation(rotor.marker, split.bodies);
  const double    r      = rotor.radius;

  Shape shape;
  shape.name                  = rotor.name;
  constexpr double disc_width = 0.25; // of its radius
  add_disc(shape, centre, pose.pin, pose.axis, r, 0.5 * disc_width * r);
  // The rib protrudes on both sides of the disc, shows the angle and extends to a joint beyond the rim.
  add_box(shape, centre + 0.5 * pose.reach * pose.pin, 0.5 * pose.reach * pose.pin, 0.09 * r * pose.ahead,
          disc_width * r * pose.axis);
  shape.displacement.assign(shape.points.size(), translation(rotor.marker, split.frame));
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
  constexpr double rod_breadth = 0.08; // of its length
  const double     breadth     = 0.5 * rod_breadth * rod.length;

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

/// How a planar or rigid body is turned.
Eigen::Matrix3d rotation(const coupling::Body &body, const Eigen::VectorXd &q)
{
  if (body.kind == coupling::BodyKind::planar)
    return Eigen::AngleAxisd(q(body.coordinate + 2), vector(body.axis)).toRotationMatrix();
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  if (body.kind == coupling::BodyKind::rigid)
    for (int i = 0; i < 3; ++i)
      turned.col(i) += q.segment<3>(body.coordinate + 3 + 3 * i);
  return turned;
}

/// A planar body, a rigid one or a point; `number` counts them.
Shape free_shape(const coupling::Body &body, int number, double machine_size, const Roundness &roundness,
                 const Eigen::VectorXd &q)
{
  const bool            planar = body.kind == coupling::BodyKind::planar;
  const Vector3d        centre = vector(body.position), moved = translation(body.marker, q);
  const double          radius = body.radius > 0. ? body.radius : (planar ? plate_radius : point_radius) * machine_size;
  const Eigen::Matrix3d turned = rotation(body, q);

  Shape shape;
  shape.name = body.name;
  if (vector(body.size).minCoeff() > 0.)
    add_box(shape, centre, 0.5 * body.size[0] * Vector3d::UnitX(), 0.5 * body.size[1] * Vector3d::UnitY(),
            0.5 * body.size[2] * Vector3d::UnitZ());
  else if (planar)
  {
    std::vector<Vector3d> corners = {centre};
    for (const auto &x : body.points)
      corners.push_back(vector(x));
    // Each a little thinner than the one before, so that no two faces lie in one plane.
    add_plate(shape, corners, vector(body.axis), radius, radius * (1. - 0.08 * (number % 6)));
  }
  else if (body.kind == coupling::BodyKind::point || body.radius > 0. || body.points.empty())
    add_sphere(shape, centre, radius, roundness.sphere);
  if (body.kind == coupling::BodyKind::rigid)
    for (const auto &x : body.points)
      if (const Vector3d arm = vector(x) - centre; arm.norm() > 1e-6 * machine_size)
        add_bar(shape, centre, centre + arm, bar_of_body * machine_size, roundness.bar);
  for (Vector3d &x : shape.points)
    x = centre + moved + turned * (x - centre);
  shape.displacement.assign(shape.points.size(), Vector3d::Zero());
  return shape;
}

/// A body as its CAD file shows it.
Shape part_shape(const Scenery &scenery, const DrawnPart &part, const coupling::Body &body, const Eigen::VectorXd &q)
{
  using coupling::BodyKind;
  const Split     split(scenery, q);
  const Vector3d  centre = vector(body.position);
  Vector3d        moved = translation(body.marker, split.bodies), small = Vector3d::Zero();
  Eigen::Matrix3d turned = rotation(body, q);
  if (body.kind == BodyKind::rotor)
  {
    turned = Eigen::AngleAxisd(q(body.coordinate), vector(body.axis).normalized()).toRotationMatrix();
    small  = translation(body.marker, split.frame);
  }
  else if (body.kind == BodyKind::slider)
  {
    const SliderPose pose(scenery, body, q);
    moved = pose.ideal * pose.axis;
    small = pose.displacement;
  }

  Shape shape;
  shape.name      = body.name;
  shape.triangles = part.triangles;
  for (const auto &x : part.points)
    shape.points.push_back(centre + moved + turned * (vector(x) - centre));
  shape.displacement.assign(shape.points.size(), small);
  return shape;
}

const DrawnPart *part_of(const Scenery &scenery, const std::string &body)
{
  const auto part = std::find_if(scenery.parts.begin(), scenery.parts.end(),
                                 [&](const DrawnPart &candidate) { return candidate.body == body; });
  return part != scenery.parts.end() ? &*part : nullptr;
}

Shape bar_shape(const coupling::DrawnBar &bar, double radius, int n_corners, const Split &split,
                const Eigen::VectorXd &q)
{
  const Vector3d from = position(bar.from, split.bodies), to = position(bar.to, split.bodies), way = to - from;
  const Vector3d at_from = position(bar.from, q) - from, at_to = position(bar.to, q) - to;

  Shape shape;
  shape.name = bar.name;
  if (!(way.norm() > 0.))
    return shape;
  add_bar(shape, from, to, radius, n_corners);
  for (const Vector3d &x : shape.points)
    shape.displacement.push_back(at_from + (x - from).dot(way) / way.squaredNorm() * (at_to - at_from));
  return shape;
}

Shape pins_shape(const Scenery &scenery, double radius, const Split &split, const Eigen::VectorXd &q)
{
  Shape shape;
  shape.name = "joints";
  for (const coupling::DrawnPin &pin : scenery.pins)
  {
    const Vector3d   at = position(pin.at, split.bodies), axis = direction(pin.at, vector(pin.axis), split.bodies);
    constexpr double pin_radius = 0.6; // of the radius of a plate
    add_disc(shape, at, axis.unitOrthogonal(), axis, pin_radius * radius, 1.4 * radius);
    shape.displacement.resize(shape.points.size(), position(pin.at, q) - at);
  }
  return shape;
}

bool is_free(const coupling::Body &body)
{
  using coupling::BodyKind;
  return body.kind == BodyKind::point || body.kind == BodyKind::planar || body.kind == BodyKind::rigid;
}

} // namespace

std::vector<Shape> mechanism_shapes(const Scenery &scenery, const Eigen::VectorXd &q)
{
  using coupling::BodyKind;
  // Rotors, sliders and rods have sizes of their own: that of the machine is not needed for them.
  const bool sizes_follow = !scenery.bars.empty() || !scenery.pins.empty() ||
                            std::any_of(scenery.bodies.begin(), scenery.bodies.end(), is_free);
  const double       size = sizes_follow ? scenery.size() : 0.;
  const Split        split(scenery, q);
  const Roundness    roundness(scenery.bodies.size() + scenery.bars.size());
  int                n_free = 0;
  std::vector<Shape> shapes;
  for (const coupling::Body &body : scenery.bodies)
    if (const DrawnPart *part = part_of(scenery, body.name))
      shapes.push_back(part_shape(scenery, *part, body, q));
    else if (is_free(body))
      shapes.push_back(free_shape(body, n_free++, size, roundness, q));
    else if (body.kind == BodyKind::rotor && body.radius > 0.)
      shapes.push_back(rotor_shape(scenery, body, q));
    else if (body.kind == BodyKind::slider && vector(body.size).minCoeff() > 0.)
      shapes.push_back(slider_shape(scenery, body, q));
  for (const coupling::DrawnRod &rod : scenery.rods)
  {
    const coupling::Body *crank = find(scenery, rod.crank), *slider = find(scenery, rod.slider);
    if (crank != nullptr && slider != nullptr && rod.length > rod.crank_radius)
      shapes.push_back(rod_shape(scenery, rod, *crank, *slider, q));
  }
  for (const coupling::DrawnBar &bar : scenery.bars)
    shapes.push_back(bar_shape(bar, bar_radius * size, roundness.bar, split, q));
  if (!scenery.pins.empty())
    shapes.push_back(pins_shape(scenery, plate_radius * size, split, q));
  return shapes;
}

} // namespace gestell::apps
