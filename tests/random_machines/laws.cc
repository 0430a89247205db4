#include "tests/random_machines/laws.h"

#include <iterator>

namespace gestell::tests
{
namespace
{
std::string begin(Draft &draft, const std::string &entries, const std::string &letter, const std::string &type)
{
  const std::string name = draft.new_name(letter);
  draft.table("element." + name);
  if (type != "hydraulic cylinder")
    draft.elements.push_back(name);
  draft.text("type", type);
  draft.machine.scene += entries;
  return name;
}

using Law = void (*)(Draft &, const Link &);
} // namespace

std::string begin_element(Draft &draft, const Link &link, const std::string &letter, const std::string &type)
{
  return begin(draft, link.entries, letter, type);
}

std::string begin_motor(Draft &draft, const Link &link, const std::string &type)
{
  return begin(draft, link.shaft, "motor", type);
}

void add_spring(Draft &draft, const Link &link, double stiffness, double damping_ratio)
{
  begin_element(draft, link, "spring", "spring-damper");
  draft.number("stiffness", stiffness);
  if (!(damping_ratio > 0.))
    return;
  lossy(draft);
  draft.number("damping", 2. * damping_ratio * std::sqrt(stiffness * link.scale.mass));
}

void add_random_law(Draft &draft, const Link &link)
{
  static const Law always[]   = {add_stop, add_stop,    add_clearance,   add_force,           add_cubic_spring,
                                 add_rope, add_formula, add_table_force, add_smooth_friction, add_profile};
  static const Law straight[] = {add_wheel, add_blanking, add_cutting, add_drawing, add_gas};
  static const Law turning[]  = {add_motor, add_dynamic_motor, add_speed_drive};
  static const Law sticking[] = {add_dry_friction, add_dry_friction, add_brake};
  const auto       any        = [&](const auto &laws) { laws[draft.dice.whole(int(std::size(laws)))](draft, link); };

  if (draft.machine.wide && !link.turns && !link.on_measure && draft.dice.chance(0.1))
    return add_cylinder(draft, link);
  const double kind = draft.dice.share();
  if (kind < 0.05 && !link.on_measure)
    add_lugre(draft, link);
  else if (kind < 0.25 && !link.on_measure && draft.may_stick(link.from, link.to))
    any(sticking);
  else if (kind < 0.45 && !link.turns)
    any(straight);
  else if (kind < 0.45 && !link.shaft.empty())
    any(turning);
  else
    any(always);
}

} // namespace gestell::tests
