#include "mechanism/elements/connecting_rod.h"

#include "apps/scene/elements/element_types.h"
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
    throw table.error("the axes of crank '" + crank.name + "' and slider '" + slider.name + "' are not perpendicular");

  const auto rod = table.filled<mechanism::ConnectingRod::Parameters>();
  add_element(scene, table, checked(table, [&] { return std::make_shared<mechanism::ConnectingRod>(rod); }),
              {{{crank.name, true, crank.axis, 1.}},
               difference(crank.name, slider.name, e, false),
               difference(crank.name, slider.name, cross(e, crank.axis), false)});
  scene.rods.push_back({table.name(), crank.name, slider.name, rod.crank_radius, rod.length});
}

ElementType connecting_rod_type()
{
  using Rod = mechanism::ConnectingRod::Parameters;
  return {"connecting rod",
          "Elastic connecting rod with play between crank and slider. At crank angle 0 (top dead centre) the slider is "
          "fully retracted.",
          "`force` along the slider's axis, `rod_force` along the rod, compression positive; `side_force`, "
          "`compression`, `compression_rate`",
          {key::named("from", "rotor that is the crank"),
           key::named("to", "slider, perpendicular to the axis of the rotor"),
           key::number("crank_radius", kind::length, "radius of the crank pin circle")
               .above_zero()
               .into(&Rod::crank_radius),
           key::number("length", kind::length, "length of the rod").above_zero().into(&Rod::length),
           key::number("stiffness", kind::stiffness, "axial stiffness of the rod").above_zero().into(&Rod::stiffness),
           key::number("damping", kind::damping, "damping while rod, pins and play are in contact")
               .from_zero()
               .by_default(&Rod::damping),
           key::number("closing_length", kind::length, "compression over which this damping builds up")
               .above_zero()
               .by_default(&Rod::closing_length),
           key::number("clearance", kind::length, "total play").from_zero().by_default(&Rod::clearance),
           key::number("oil_damping", kind::damping, "damping of the oil film, which always acts")
               .from_zero()
               .by_default(&Rod::oil_damping)},
          read_connecting_rod,
          {R"toml(from         = "crank"
to           = "slide"
crank_radius = "80 mm"
length       = "800 mm"
stiffness    = "900 kN/mm"
clearance    = "0.4 mm"
)toml"}};
}

} // namespace gestell::apps
