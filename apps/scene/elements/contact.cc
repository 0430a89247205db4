#include "mechanism/elements/point_contact.h"

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

void add_point(Scene &scene, const SceneTable &table, const std::string &name, const PlaceRequest &plane,
               const PlaceRequest &point, const Vector3 &normal, const PointContact::Parameters &contact)
{
  const auto [e_1, e_2] = coupling::plane_across(normal);
  ElementRequest element;
  element.name    = name;
  element.element = checked(table, [&] { return std::make_shared<PointContact>(contact); });
  element.pair    = PairRequest{plane, point, {normal, e_1, e_2}, {}};
  scene.elements.push_back(element);
  scene.element_places[name] = table.place();
}

void check_two_bodies(const SceneTable &table, const PlaceRequest &from, const PlaceRequest &to)
{
  if (from.marker == to.marker)
    throw table.error("to", "lies on '" + to.marker + "' like `from`; a contact is one of two bodies");
}

} // namespace

/// A point of `from` on a plane that `to` carries.
void read_contact_point(const SceneTable &table, const Names &names, Scene &scene)
{
  for (const char *key : {"at_from", "at_to"})
    if (table.has(key))
      throw table.error(key, "is no key of a contact: the point of `from` is `at`, a point of the plane `through`");
  const PlaceRequest point = names.place(table, "from");
  PlaceRequest       plane = names.place(table, "to", "through", "ground");
  check_two_bodies(table, point, plane);
  const Vector3 normal = table.direction("normal");
  if (!plane.at)
    plane.at = point.at;
  if (!plane.at)
    throw table.error("needs 'through', a point of the plane in the position the scene describes");
  PointContact::Parameters contact{read_contact(table, false), read_sliding_friction(table)};
  contact.normal.stops = Clearance::Stops::below;
  add_point(scene, table, table.name(), plane, point, normal, contact);
}

/// A slide of some length between two parallel planes of its guide: four points, two at either end.
void read_guide_with_play(const SceneTable &table, const Names &names, Scene &scene)
{
  const PlaceRequest guide{names.marker(table, "from"), {}}, slide = names.place(table, "to");
  check_two_bodies(table, guide, slide);
  if (!slide.at)
    throw table.error("needs 'at', the middle of the slide in the position the scene describes");
  const Vector3 axis = table.direction("axis"), normal = table.direction("normal");
  if (std::abs(axis[0] * normal[0] + axis[1] * normal[1] + axis[2] * normal[2]) > 1e-9)
    throw table.error("normal", "must be at right angles to 'axis': the play lies across the guide");
  PointContact::Parameters contact{read_contact(table, false), read_sliding_friction(table)};
  contact.normal.gap   = table.not_negative("gap", kind::length);
  contact.normal.stops = Clearance::Stops::both;
  const double length  = table.positive("length", kind::length);
  for (const double end : {-1., 1.})
  {
    PlaceRequest point = slide;
    for (int d = 0; d < 3; ++d)
      (*point.at)[d] += 0.5 * end * length * axis[d];
    add_point(scene, table, table.name() + (end < 0. ? ".rear" : ".front"), {guide.marker, point.at}, point, normal,
              contact);
  }
}

} // namespace gestell::apps
