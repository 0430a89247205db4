#include "mechanism/elements/clearance.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/relative_motion.h"

namespace gestell::apps
{
namespace
{

using mechanism::Clearance;

void add_contact(Scene &scene, const SceneTable &table, const RelativeMotion &motion,
                 const Clearance::Parameters &contact)
{
  add_element_on(scene, table, checked(table, [&] { return std::make_shared<Clearance>(contact); }), motion);
}

} // namespace

void read_clearance(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion  = read_relative_motion(table, names);
  auto       contact = read_contact(table, motion.rotation);
  contact.gap        = table.not_negative("gap", motion.rotation ? kind::angle : kind::length);
  add_contact(scene, table, motion, contact);
}

/// One-sided: closed where u > gap, or -u > gap below.
void read_stop(const SceneTable &table, const Names &names, Scene &scene)
{
  const auto motion  = read_relative_motion(table, names);
  const bool turns   = motion.rotation;
  auto       contact = read_contact(table, turns);
  contact.gap        = table.number("gap", turns ? kind::angle : kind::length, 0.);
  contact.stops =
      table.choice("side", {"above", "below"}, "above") == "above" ? Clearance::Stops::above : Clearance::Stops::below;
  add_contact(scene, table, motion, contact);
}

} // namespace gestell::apps
