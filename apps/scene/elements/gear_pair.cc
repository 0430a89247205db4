#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_wheels.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/common_tangents.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using mechanism::GearPair;

/// Pitch circles and angles of a gear pair in the initial configuration.
struct Teeth
{
  double from = 0., to = 0.;                 ///< pitch radii [m]; `to` negative: a ring
  double pressure_angle = 20. * M_PI / 180.; ///< alpha_n, normal to the teeth
  double helix_angle    = 0.;                ///< beta

  double transverse() const { return std::atan(std::tan(pressure_angle) / std::cos(helix_angle)); } ///< alpha_t
  double base_helix() const { return std::asin(std::sin(helix_angle) * std::cos(pressure_angle)); } ///< beta_b
};

void check_angles(const SceneTable &table, const Teeth &teeth)
{
  if (!(teeth.pressure_angle > 0. && teeth.pressure_angle < 0.25 * M_PI))
    throw table.error("pressure_angle", "must be between 0 and 45 degrees; usually 20 degrees");
  if (!(std::abs(teeth.helix_angle) < M_PI / 3.))
    throw table.error("helix_angle", "must be between -60 and 60 degrees; usually up to 45 degrees");
}

/// Pitch radii that add up to the distance of the centres exactly.
void fit(const SceneTable &table, Teeth &teeth, double distance)
{
  if (teeth.to == 0. || (teeth.to < 0. && -teeth.to <= teeth.from))
    throw table.error("radius_to", "must be positive, or for a ring negative and larger than 'radius_from'");
  const double     fitting = std::abs(teeth.from + teeth.to);
  constexpr double rounded = 1e-4; // radii are given to a hundredth of a millimetre on some hundred
  if (!(std::abs(fitting - distance) <= rounded * distance))
    throw table.error("pitch radii of " + short_text(teeth.from, 6) + " m and " + short_text(teeth.to, 6) +
                      " m need a centre distance of " + short_text(fitting, 6) + " m, but their centres are " +
                      short_text(distance, 6) + " m apart; correct 'at_from', 'at_to' or the radii");
  teeth.from *= distance / fitting;
  teeth.to *= distance / fitting;
}

void read_gear_pair(const SceneTable &table, const Names &names, Scene &scene)
{
  const WheelPair wheels = read_wheels(table, names, "gear");
  auto            teeth  = table.filled<Teeth>();
  check_angles(table, teeth);
  fit(table, teeth, wheels.distance);

  const double         base = std::cos(teeth.transverse()), helix = teeth.base_helix();
  GearPair::Parameters mesh = table.filled<GearPair::Parameters>();
  mesh.initial              = -0.5 * table.value("backlash");
  mesh.circles              = base * std::abs(teeth.from + teeth.to);
  mesh.distance             = wheels.distance;
  // Teeth of outer gears are loaded where a crossed belt on the base circles would slacken, those of a ring where an
  // open one would be pulled.
  const double    sense = teeth.to > 0. ? -1. : 1.;
  TangentsRequest flanks;
  flanks.first       = base * teeth.from;
  flanks.second      = -base * teeth.to;
  flanks.factor      = sense * std::cos(helix);
  flanks.advance     = sense * std::sin(helix);
  flanks.pitch_point = -sense * teeth.from;
  flanks.winds       = true;
  add_on_tangents(scene, table, checked(table, [&] { return std::make_shared<GearPair>(mesh, -sense * helix); }),
                  wheels, flanks);
}

} // namespace

ElementType gear_pair_type()
{
  using Mesh = GearPair::Parameters;
  return {"gear pair",
          "Elastic mesh of two gears with backlash. Each flank is a spring along its line of action that only pushes. "
          "Events: `left_contact`, `left_separation`, with damping also `left_relaxed` at the free length; the same "
          "for `right`.",
          "`force` normal to the teeth, positive if it turns `to` positively about `axis`; its components "
          "`tangential_force`, `radial_force` (positive if it separates the gears, or pushes the gear out of its ring) "
          "and `axial_force` on `to` along `axis`",
          joined({wheel_keys("gear"),
                  {key::number("radius_from", kind::length, "pitch radius of the gear on `from`")
                       .above_zero()
                       .into(&Teeth::from),
                   key::number("radius_to", kind::length,
                               "pitch radius of the gear on `to`; negative for an internal (ring) gear. The centre "
                               "distance must equal the sum of both radii within 1e-4")
                       .into(&Teeth::to),
                   key::number("pressure_angle", kind::angle, "normal pressure angle")
                       .by_default("20 deg")
                       .into(&Teeth::pressure_angle),
                   key::number("helix_angle", kind::angle,
                               "helix angle on the pitch circle; positive if the gear on `from` is right-handed")
                       .by_default(&Teeth::helix_angle),
                   key::number("stiffness", kind::stiffness, "mesh stiffness normal to the teeth, mean over a pitch")
                       .above_zero()
                       .into(&Mesh::stiffness),
                   key::number("damping", kind::damping, "damping in the same direction while the teeth touch")
                       .from_zero()
                       .by_default(&Mesh::damping),
                   key::number(
                       "backlash", kind::length,
                       "play between the flanks, normal to the teeth, in the initial configuration; half on each side")
                       .from_zero()
                       .by_default(0.)}}),
          read_gear_pair,
          {wheel_example() + R"toml(radius_from    = "170 mm"
radius_to      = "430 mm"
pressure_angle = "20 deg"
helix_angle    = "15 deg"
stiffness      = "400 kN/mm"
damping        = "5 kN s/m"
backlash       = "0.1 mm"
)toml"}};
}

} // namespace gestell::apps
