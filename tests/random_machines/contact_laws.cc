#include "tests/random_machines/laws.h"

namespace gestell::tests
{
namespace
{
/// @return whether it loses energy
bool contact_loss(Draft &draft, const Link &link)
{
  const double speed = link.scale.speed();
  if (draft.dice.chance(0.3))
    return false;
  lossy(draft);
  if (draft.dice.chance(0.5))
  {
    draft.number("restitution", draft.dice.between(0.2, 1.));
    draft.number("impact_speed", speed * draft.dice.log_between(0.1, 3.));
  }
  else
    draft.number("dissipation", draft.dice.log_between(0.01, 2.) / speed);
  return true;
}

void contact_stiffness(Draft &draft, const Link &link)
{
  const double stiffness = link.scale.stiffness() * draft.dice.log_between(3., 1000.);
  if (draft.dice.chance(0.7))
  {
    draft.number("stiffness", stiffness);
    return;
  }
  draft.number("exponent", 1.5);
  // as stiff as the linear one at a hundredth of the motion
  draft.number("stiffness", stiffness / std::sqrt(0.01 * link.scale.length));
}

} // namespace

void add_stop(Draft &draft, const Link &link)
{
  const std::string name  = begin_element(draft, link, "stop", "stop");
  const bool        below = draft.dice.chance(0.5);
  nonlinear(draft);
  contact_stiffness(draft, link);
  draft.number("gap", link.scale.length * draft.dice.between(0.05, 1.));
  if (below)
    draft.text("side", "below");
  const bool loses = contact_loss(draft, link);
  draft.machine.contacts.push_back({name, below ? -1 : 1, loses});
  draft.watch(name + ".force");
}

void add_clearance(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "play", "clearance");
  nonlinear(draft);
  contact_stiffness(draft, link);
  draft.number("gap", draft.dice.chance(0.1) ? 0. : link.scale.length * draft.dice.between(0.02, 0.8));
  const bool loses = contact_loss(draft, link);
  draft.machine.contacts.push_back({name, 0, loses});
  draft.watch(name + ".force");
  draft.watch(name + ".displacement");
}

void add_rope(Draft &draft, const Link &link)
{
  const std::string name      = begin_element(draft, link, "rope", "rope");
  const double      stiffness = link.scale.stiffness() * draft.dice.log_between(1., 100.);
  nonlinear(draft);
  draft.number("stiffness", stiffness);
  draft.number("slack", link.scale.length * draft.dice.between(-0.5, 0.8));
  if (draft.dice.chance(0.6))
  {
    lossy(draft);
    draft.number("damping", draft.dice.log_between(0.005, 0.5) * std::sqrt(stiffness * link.scale.mass));
  }
  draft.machine.contacts.push_back({name, 1});
  draft.watch(name + ".force");
}

void add_wheel(Draft &draft, const Link &link)
{
  const std::string name      = begin_element(draft, link, "wheel", "wheel");
  const double      stiffness = link.scale.stiffness() * draft.dice.log_between(1., 30.);
  nonlinear(draft);
  draft.number("stiffness", stiffness);
  if (draft.dice.chance(0.7))
  {
    lossy(draft);
    draft.number("damping", draft.dice.log_between(0.005, 0.5) * std::sqrt(stiffness * link.scale.mass));
  }
  if (draft.dice.chance(0.2))
    draft.line("bilateral = true");
  else
    draft.machine.contacts.push_back({name, 1});
  draft.watch(name + ".force");
}

} // namespace gestell::tests
