#include "apps/scene/build/carried_bodies.h"

#include "apps/scene/build/build_measures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <sstream>

namespace gestell::apps
{

namespace
{

/// The carrier if it is a body that can rotate through large angles about an own axis.
const coupling::Body *turning_carrier(const coupling::MachineModel &machine, const std::string &name)
{
  for (const coupling::Body &body : machine.bodies())
    if (body.name == name && (body.kind == coupling::BodyKind::rotor || body.kind == coupling::BodyKind::planar))
      return &body;
  return nullptr;
}

/// Largest distance [m] that rotations of the carrier would move the mass by, per radian: what is left out.
double left_out(const coupling::Marker &carrier, const BodyRequest &body, const Eigen::Vector3d &arm)
{
  double most = 0.;
  for (int d = 0; d < 3; ++d)
  {
    Eigen::Vector3d moved = Eigen::Vector3d::Unit(d).cross(arm);
    if (body.kind == coupling::BodyKind::slider) // along its axis it moves on its own
      moved -= moved.dot(vector(body.axis)) * vector(body.axis);
    if (!carrier.rotation[d].empty())
      most = std::max(most, moved.norm());
  }
  return most;
}

} // namespace

void check_carrier(const coupling::MachineModel &machine, const BodyRequest &body)
{
  const coupling::Body *carrier = turning_carrier(machine, body.carrier);
  if (!carrier)
    return;
  const Eigen::Vector3d n    = vector(carrier->axis).normalized();
  const Eigen::Vector3d arm  = vector(body.position) - vector(carrier->centre);
  const double          size = vector(body.position).norm() + vector(carrier->centre).norm();
  // share of the places' distances, or of a unit vector: what ten written digits leave
  constexpr double on_axis    = 1e-9;
  const bool       off        = body.position != Vector3{} && n.cross(arm).norm() > on_axis * size;
  const bool       turns_axis = n.cross(vector(body.axis).normalized()).norm() > on_axis;
  const bool       slider     = body.kind == coupling::BodyKind::slider;
  if (!off && !turns_axis)
    return;
  throw std::invalid_argument((slider ? "slider \"" : "rotor \"") + body.name + "\": its " +
                              (slider ? "guide" : "carrier") + " \"" + carrier->name +
                              "\" rotates through large angles, which " +
                              (turns_axis ? "its axis" : "its position off the axis of \"" + carrier->name + "\"") +
                              " cannot follow; make it a planar body with a " +
                              (slider ? "prismatic joint" : "revolute joint at its position"));
}

std::vector<std::string> carried_warnings(const Scene &scene, const coupling::MachineModel &machine)
{
  Eigen::AlignedBox3d box;
  for (const BodyRequest &body : scene.bodies)
    box.extend(vector(machine.body(body.name).position));
  for (const BodyRequest &body : scene.bodies)
    if (!body.carrier.empty() && body.carrier != "ground")
      box.extend(vector(machine.position(body.carrier)));
  std::vector<std::string> warnings;
  for (const BodyRequest &body : scene.bodies)
  {
    if (body.carrier.rfind("frame.", 0) != 0 || body.mass == 0. || body.position == Vector3{})
      continue;
    const Eigen::Vector3d arm      = vector(body.position) - vector(machine.position(body.carrier));
    const double          distance = left_out(machine.marker(body.carrier), body, arm);
    constexpr double      far_away = 0.1; // share of the size of the machine: what carries a body is near it
    if (distance > far_away * box.diagonal().norm())
    {
      std::ostringstream text;
      text.precision(3);
      text << body.place << ": the mass of \"" << body.name << "\" acts at the reference point of \"" << body.carrier
           << "\", " << distance << " m from its own position, so its inertia about that point is omitted; "
           << (body.kind == coupling::BodyKind::rotor
                   ? "omit the mass and add a point mass with an offset instead"
                   : "add an interface at its position, or make it a planar body with a prismatic joint");
      warnings.push_back(text.str());
    }
  }
  return warnings;
}

} // namespace gestell::apps
