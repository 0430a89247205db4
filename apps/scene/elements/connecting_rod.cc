#include "mechanism/elements/connecting_rod.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/relative_motion.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

Vector3 cross(const Vector3 &a, const Vector3 &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

} // namespace

/// Measures: phi about the crank's axis a; s along the slider's axis e and y along e x a, of (crank - slider).
void read_connecting_rod(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto &crank  = names.body(table, "from", coupling::BodyKind::rotor);
  const auto &slider = names.body(table, "to", coupling::BodyKind::slider);
  const auto &e      = slider.axis;
  if (const auto &a = crank.axis; std::abs(a[0] * e[0] + a[1] * e[1] + a[2] * e[2]) > 1e-9)
    throw table.error("the axes of crank '" + crank.name + "' and slider '" + slider.name +
                      "' are not at right angles");

  mechanism::ConnectingRod::Parameters rod;
  rod.crank_radius   = table.positive("crank_radius", kind::length);
  rod.length         = table.positive("length", kind::length);
  rod.stiffness      = table.positive("stiffness", kind::stiffness);
  rod.damping        = table.not_negative("damping", kind::damping, rod.damping);
  rod.closing_length = table.positive("closing_length", kind::length, rod.closing_length);
  rod.clearance      = table.not_negative("clearance", kind::length, rod.clearance);
  rod.oil_damping    = table.not_negative("oil_damping", kind::damping, rod.oil_damping);

  add_element(scene, table, checked(table, [&] { return std::make_shared<mechanism::ConnectingRod>(rod); }),
              {{{crank.name, true, crank.axis, 1.}},
               difference(crank.name, slider.name, e, false),
               difference(crank.name, slider.name, cross(e, crank.axis), false)});
  scene.rods.push_back({table.name(), crank.name, slider.name, rod.crank_radius, rod.length});
}

} // namespace gestell::apps
