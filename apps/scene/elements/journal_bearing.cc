#include "mechanism/elements/journal_bearing.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/relative_motion.h"

#include <cmath>

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

} // namespace

void read_journal_bearing(const SceneTable &table, const Names &names, Scene &scene)
{
  const bool  one_point = table.has("at");
  PairRequest pair{names.place(table, "from", one_point ? "at" : "at_from"),
                   names.place(table, "to", one_point ? "at" : "at_to"),
                   {},
                   table.direction("axis")};
  if (pair.from.marker == pair.to.marker)
    throw table.error("to", "lies on '" + pair.to.marker + "' like `from`; a bearing holds one body in another");
  if (!pair.from.at && !pair.to.at)
    throw table.error("needs 'at', the middle of the bearing in the position the scene describes");
  if (!pair.to.at)
    pair.to.at = pair.from.at;
  if (!pair.from.at)
    pair.from.at = pair.to.at;
  pair.along = right_handed_plane(*pair.about);

  const auto                            contact = read_contact(table, false);
  mechanism::JournalBearing::Parameters bearing;
  bearing.clearance   = table.positive("clearance", kind::length);
  bearing.stiffness   = contact.stiffness;
  bearing.dissipation = contact.dissipation;
  bearing.exponent    = contact.exponent;
  bearing.friction    = read_sliding_friction(table);
  bearing.radius      = table.positive("radius", kind::length, 0.);
  if ((bearing.friction.kinetic > 0. || bearing.friction.static_coefficient > 0.) && bearing.radius == 0.)
    throw table.error("needs 'radius' of the journal: its surface slides with radius times the speed of rotation");
  ElementRequest element;
  element.name    = table.name();
  element.element = checked(table, [&] { return std::make_shared<mechanism::JournalBearing>(bearing); });
  element.pair    = pair;
  scene.elements.push_back(element);
}

} // namespace gestell::apps
