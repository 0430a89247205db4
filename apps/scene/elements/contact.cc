#include "mechanism/elements/point_contact.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/relative_motion.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

using mechanism::Clearance;
using mechanism::PointContact;

/// The point's motion along the normal of the plane and across.
PairRequest point_on_plane(const PlaceRequest &plane, const PlaceRequest &point, const Vector3 &normal)
{
  const auto [e_1, e_2] = coupling::plane_across(normal);
  return {plane, point, {normal, e_1, e_2}, {}};
}

void add_point(Scene &scene, const SceneTable &table, const std::string &name, const PairRequest &pair,
               const PointContact::Parameters &contact)
{
  ElementRequest element;
  element.name    = name;
  element.element = checked(table, [&] { return std::make_shared<PointContact>(contact); });
  element.pair    = pair;
  scene.elements.push_back(element);
  scene.element_places[name] = table.place();
}

void check_two_bodies(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to)
{
  if (from.marker == to.marker)
    throw table.error("to", "is on '" + to.marker + "', the body of `from`; a contact needs two bodies");
}

} // namespace

/// A point of `from` on a plane that `to` carries.
void read_contact_point(const SceneTable &table, const Names &names, Scene &scene)
{
  for (const char *key : {"at_from", "at_to"})
    if (table.has(key))
      throw table.error(key, "is not a key of a contact: the point of `from` is `at`, a point of the plane `through`");
  const PlaceRequest point = names.place(table, "from");
  PlaceRequest       plane = names.place(table, "to", "through", "ground");
  check_two_bodies(table, point, plane);
  const Vector3 normal = table.direction("normal");
  if (!plane.at)
    plane.at = point.at;
  if (!plane.at)
    throw table.error("needs 'through', a point of the plane in the reference configuration");
  PointContact::Parameters contact{read_contact(table, false), read_sliding_friction(table)};
  contact.normal.stops = Clearance::Stops::below;
  add_point(scene, table, table.name(), point_on_plane(plane, point, normal), contact);
}

/// A slide of some length between two parallel planes of its guide: four points, two at either end.
void read_guide_with_play(const SceneTable &table, const Names &names, Scene &scene)
{
  const PlaceRequest guide{names.marker(table, "from"), {}}, slide = names.place(table, "to");
  check_two_bodies(table, guide, slide);
  if (!slide.at)
    throw table.error("needs 'at', the centre of the slide in the reference configuration");
  const Vector3 axis = table.direction("axis"), normal = table.direction("normal");
  if (std::abs(axis[0] * normal[0] + axis[1] * normal[1] + axis[2] * normal[2]) > 1e-9)
    throw table.error("normal", "must be perpendicular to 'axis': the clearance is across the guide");
  PointContact::Parameters contact{read_contact(table, false), read_sliding_friction(table)};
  const double             length = table.value("length");
  for (const double end : {-1., 1.})
  {
    PlaceRequest point = slide;
    for (int d = 0; d < 3; ++d)
      (*point.at)[d] += 0.5 * end * length * axis[d];
    add_point(scene, table, table.name() + (end < 0. ? ".rear" : ".front"),
              point_on_plane({guide.marker, point.at}, point, normal), contact);
  }
}

ElementType contact_type()
{
  return {
      "contact",
      "Contact of a point of a body with a plane on another body. Located events: `contact`, `separation`.",
      "`normal_force`, `friction_force`, `distance`, `sliding_speed`",
      joined({{key::named("from", "body with the contact point"),
               key::vector("at", kind::length, "contact point in the reference configuration")
                   .by_default("reference point of the body"),
               key::named("to", "body or interface that carries the plane").by_default("ground"),
               key::direction("normal", "normal of the plane, pointing outwards"),
               key::vector("through", kind::length, "point of the plane").by_default("`at`"),
               key::vector("at_from", kind::length, "not accepted: the contact point is `at`").by_default(""),
               key::vector("at_to", kind::length, "not accepted: the point of the plane is `through`").by_default("")},
              contact_keys(),
              {sliding_friction_key()}}),
      read_contact_point,
      {R"toml(from      = "lance"
at        = ["0.9 m", 0, 0]
normal    = [0, 0, 1]
stiffness = "2 kN/mm"
friction  = 0.2
)toml",
       R"toml(from      = "lance"
at        = ["0.9 m", 0, 0]
normal    = [0, 0, 1]
stiffness = "2 kN/mm"
friction  = { coefficient = 0.1, static = 0.15, stribeck_speed = "10 mm/s" }
)toml"}};
}

ElementType guide_with_play_type()
{
  return {
      "guide with play",
      "Slide between two parallel planes of its guide, with a contact at each of its four corners.",
      "those of a contact for `NAME.rear` and `NAME.front` (rear and front end along `axis`), `normal_force` along "
      "`normal`",
      joined({{key::named("from", "guide"), key::named("to", "slide"),
               key::vector("at", kind::length, "centre of the slide in the reference configuration")
                   .by_default("marker `to`"),
               key::direction("axis", "direction of the guide"), key::direction("normal", "normal of the guide planes"),
               key::number("gap", kind::length, "half the total play").from_zero().into(&Clearance::Parameters::gap),
               key::number("length", kind::length, "length of the slide").above_zero()},
              contact_keys(),
              {sliding_friction_key()}}),
      read_guide_with_play,
      {R"toml(from      = "ground"
to        = "lance"
at        = ["0.9 m", 0, 0]
axis      = [1, 0, 0]
normal    = [0, 0, 1]
gap       = "50 um"
length    = "200 mm"
stiffness = "200 kN/mm"
)toml"}};
}

} // namespace gestell::apps
