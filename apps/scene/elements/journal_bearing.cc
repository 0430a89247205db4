#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/rolling_bearing.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{

/// e1, e2 with e1 x e2 along n.
std::vector<Vector3> right_handed_plane(const Vector3 &n)
{
  auto [e_1, e_2]   = coupling::plane_across(n);
  const double turn = n[0] * (e_1[1] * e_2[2] - e_1[2] * e_2[1]) + n[1] * (e_1[2] * e_2[0] - e_1[0] * e_2[2]) +
                      n[2] * (e_1[0] * e_2[1] - e_1[1] * e_2[0]);
  if (turn < 0.)
    e_2 = {-e_2[0], -e_2[1], -e_2[2]};
  return {e_1, e_2};
}

/// The bearing and its journal, with displacements across the axis.
PairRequest read_bearing(const SceneTable &table, const Names &names)
{
  const bool  one_point = table.has("at");
  PairRequest pair{names.place(table, "from", one_point ? "at" : "at_from"),
                   names.place(table, "to", one_point ? "at" : "at_to"),
                   right_handed_plane(table.direction("axis")),
                   {}};
  if (pair.from.marker == pair.to.marker)
    throw table.error("to", "is on '" + pair.to.marker + "', the body of `from`; a bearing connects two bodies");
  if (!pair.from.at && !pair.to.at)
    throw table.error("needs 'at', the centre of the bearing in the reference configuration");
  if (!pair.to.at)
    pair.to.at = pair.from.at;
  if (!pair.from.at)
    pair.from.at = pair.to.at;
  return pair;
}

std::vector<Key> bearing_keys()
{
  return {key::named("from", "bearing"),
          key::named("to", "journal"),
          key::vector("at", kind::length, "centre of the bearing in the initial configuration")
              .by_default("`at_from`, `at_to`"),
          key::vector("at_from", kind::length, "centre of the bearing").by_default("`at`"),
          key::vector("at_to", kind::length, "centre of the journal").by_default("`at`"),
          key::direction("axis", "axis of the bearing")};
}

void add_bearing(Scene &scene, const SceneTable &table, std::shared_ptr<mechanism::ForceLaw> law,
                 const PairRequest &pair)
{
  ElementRequest element;
  element.name    = table.name();
  element.element = std::move(law);
  element.pair    = pair;
  scene.elements.push_back(std::move(element));
}

} // namespace

void read_journal_bearing(const SceneTable &table, const Names &names, Scene &scene)
{
  PairRequest pair = read_bearing(table, names);
  pair.about       = table.direction("axis");

  const auto contact  = read_contact(table, false);
  auto       bearing  = table.filled<mechanism::JournalBearing::Parameters>();
  bearing.stiffness   = contact.stiffness;
  bearing.dissipation = contact.dissipation;
  bearing.exponent    = contact.exponent;
  bearing.friction    = read_sliding_friction(table);
  if ((bearing.friction.kinetic > 0. || bearing.friction.static_coefficient > 0.) && bearing.radius == 0.)
    throw table.error("needs 'radius' of the journal: its surface slides with radius times the speed of rotation");
  add_bearing(scene, table, checked(table, [&] { return std::make_shared<mechanism::JournalBearing>(bearing); }), pair);
}

ElementType journal_bearing_type()
{
  using Bearing = mechanism::JournalBearing::Parameters;
  return {"journal bearing",
          "Journal in a bearing with radial play.",
          "`force`, `normal_force`, `friction_force`, `eccentricity`, `contact_angle` about `axis`, `sliding_speed`",
          joined({bearing_keys(),
                  {key::number("clearance", kind::length, "radial play").above_zero().into(&Bearing::clearance),
                   key::number("radius", kind::length, "radius of the journal, required for friction")
                       .above_zero()
                       .by_default(&Bearing::radius)},
                  contact_keys(),
                  {sliding_friction_key()}}),
          read_journal_bearing,
          {R"toml(from      = "ground"
to        = "lance"
at        = [0, 0, 0]
axis      = [0, 1, 0]
clearance = "50 um"
stiffness = "500 N/um"
friction  = 0.05
radius    = "20 mm"
)toml",
           R"toml(from      = "ground"
to        = "lance"
at_from   = [0, 0, 0]
at_to     = [0, 0, 0]
axis      = [0, 1, 0]
clearance = "50 um"
stiffness = "500 N/um"
)toml"}};
}

void read_rolling_bearing(const SceneTable &table, const Names &names, Scene &scene)
{
  PairRequest pair = read_bearing(table, names);
  pair.along.push_back(table.direction("axis"));
  auto bearing = table.filled<mechanism::RollingBearing::Parameters>();
  for (const auto &[deflection, force] : table.pairs("table", kind::length, kind::force))
    bearing.rows.push_back({deflection, force});
  add_bearing(scene, table, checked(table, [&] { return std::make_shared<mechanism::RollingBearing>(bearing); }), pair);
}

ElementType rolling_bearing_type()
{
  using Bearing = mechanism::RollingBearing::Parameters;
  return {"rolling bearing",
          "Rolling bearing: radial force from a table of force over deflection, the same in every radial direction.",
          "`force` radial, `axial_force`, `eccentricity`",
          joined({bearing_keys(),
                  {key::composed("table", Key::Form::rows, kind::force, {},
                                 "rows of radial deflection and force in ascending order, without the row at zero; the "
                                 "stiffness is continuous, and constant beyond the last row"),
                   key::number("axial_stiffness", kind::stiffness, "axial stiffness")
                       .from_zero()
                       .by_default(&Bearing::axial_stiffness),
                   key::number("damping", kind::damping, "damping in every direction")
                       .from_zero()
                       .by_default(&Bearing::damping)}}),
          read_rolling_bearing,
          {R"toml(from            = "ground"
to              = "lance"
at              = [0, 0, 0]
axis            = [0, 1, 0]
table           = [["5 um", "1.5 kN"], ["10 um", "3.5 kN"], ["20 um", "9 kN"]]
axial_stiffness = "100 N/um"
damping         = "2 kN s/m"
)toml",
           R"toml(from            = "ground"
to              = "lance"
at_from         = [0, 0, 0]
at_to           = [0, 0, 0]
axis            = [0, 1, 0]
table           = [["5 um", 0], ["10 um", "0.8 kN"], ["20 um", "4.5 kN"]]
)toml"}};
}

} // namespace gestell::apps
