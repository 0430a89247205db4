#include "apps/scene/build/build_unbalance.h"

#include "mechanism/elements/unbalance.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using coupling::operator*, coupling::operator+; // of measures

Vector3 cross(const Vector3 &a, const Vector3 &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector3 &a, const Vector3 &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// e . (translation + rotation x arm) = e . translation + (arm x e) . rotation
coupling::Measure moved_along(const Vector3 &e, const coupling::Marker &marker, const Vector3 &arm)
{
  const Vector3     turned = cross(arm, e);
  coupling::Measure u;
  for (int d = 0; d < 3; ++d)
    u = u + e[d] * marker.translation[d] + turned[d] * marker.rotation[d];
  return u;
}

/// Places beside a carrier that turns by any angle are carried round, which small motions are not.
void refuse_carried_round(const coupling::MachineModel &machine, const BodyRequest &rotor, const Vector3 &arm)
{
  for (const coupling::Body &body : machine.bodies())
    if (body.name == rotor.carrier && body.kind != coupling::BodyKind::slider &&
        body.kind != coupling::BodyKind::point && dot(cross(arm, body.axis), cross(arm, body.axis)) > 0.)
      throw std::invalid_argument(
          "the unbalance lies beside \"" + rotor.carrier +
          "\", which turns by any angle and would "
          "carry it round; put unbalance_position on its axis, or the rotor on a body of its own");
}

} // namespace

void attach_unbalance(coupling::MachineModel &machine, const BodyRequest &rotor, const Vector3 &gravity)
{
  const coupling::Marker &carrier = machine.marker(rotor.carrier);
  const Vector3           e_1 = coupling::plane_across(rotor.axis).first, e_2 = cross(rotor.axis, e_1);
  Vector3                 arm{};
  if (rotor.unbalance->position && rotor.carrier != "ground")
  {
    const Vector3 origin = machine.position(rotor.carrier);
    for (int d = 0; d < 3; ++d)
      arm[d] = (*rotor.unbalance->position)[d] - origin[d];
  }
  refuse_carried_round(machine, rotor, arm);
  mechanism::Unbalance::Parameters own;
  own.unbalance  = rotor.unbalance->amount;
  own.phase      = rotor.unbalance->phase;
  own.gravity[0] = dot(gravity, e_1);
  own.gravity[1] = dot(gravity, e_2);
  machine.attach(
      rotor.name + " unbalance", std::make_shared<mechanism::Unbalance>(own),
      {{{machine.body(rotor.name).coordinate, 1.}}, moved_along(e_1, carrier, arm), moved_along(e_2, carrier, arm)});
}

} // namespace gestell::apps
