#include "tests/random_machines/laws.h"

namespace gestell::tests
{
namespace
{
void stribeck(Draft &draft, const Link &link, FrictionFact &fact)
{
  if (draft.dice.chance(0.3))
  {
    fact.stribeck_speed = draft.number("stribeck_speed", link.scale.speed() * draft.dice.log_between(0.03, 1.));
    if (draft.dice.chance(0.5))
      fact.exponent = draft.number("stribeck_exponent", 2.);
  }
  if (draft.dice.chance(0.3))
    fact.viscous = draft.number("viscous", link.scale.damping() * draft.dice.log_between(0.003, 0.3));
}

} // namespace

void add_dry_friction(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "rub", "dry friction");
  FrictionFact      fact;
  lossy(draft);
  nonlinear(draft);
  fact.name    = name;
  fact.sliding = draft.number("kinetic_force", link.scale.force() * draft.dice.log_between(0.02, 1.5));
  fact.holding =
      draft.number("static_force", fact.sliding * (draft.dice.chance(0.3) ? 1. : draft.dice.between(1., 2.)));
  stribeck(draft, link, fact);
  if (draft.dice.chance(0.2))
  {
    fact.belt = draft.number("speed", link.scale.speed() * draft.dice.sign() * draft.dice.log_between(0.03, 1.));
    draft.machine.passive = false;
  }
  draft.machine.frictions.push_back(fact);
  draft.watch(name + ".force");
  draft.watch(name + ".rate");
}

void add_brake(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "brake", "brake");
  const double      end  = 3. * 2. * M_PI / link.scale.omega;
  FrictionFact      fact;
  lossy(draft);
  nonlinear(draft);
  fact.name    = name;
  fact.engaged = false;
  fact.sliding = draft.number("capacity", link.scale.force() * draft.dice.log_between(0.05, 2.));
  fact.holding =
      draft.number("static_capacity", fact.sliding * (draft.dice.chance(0.4) ? 1. : draft.dice.between(1., 2.)));
  stribeck(draft, link, fact);
  const double from = draft.dice.between(0., 0.5) * end, rate = draft.dice.log_between(1., 30.) / end;
  draft.line("engagement = [{ at = " + digits(from) + ", to = " + digits(draft.dice.between(0.3, 1.)) +
             (draft.dice.chance(0.8) ? ", rate = \"" + digits(rate) + "/s\"" : "") +
             " }, { at = " + digits(from + 1.1 / rate + draft.dice.between(0., 0.5) * end) + ", to = 0 }]");
  draft.machine.frictions.push_back(fact);
  draft.watch(name + ".force");
  draft.watch(name + ".rate");
}

void add_smooth_friction(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "drag", "friction");
  lossy(draft);
  nonlinear(draft);
  const double force = draft.number("force", link.scale.force() * draft.dice.log_between(0.02, 1.));
  draft.number("speed", link.scale.speed() * draft.dice.log_between(0.005, 0.3));
  if (draft.dice.chance(0.3))
  {
    draft.number("static_force", force * draft.dice.between(1., 2.));
    draft.number("stribeck_speed", link.scale.speed() * draft.dice.log_between(0.05, 1.));
  }
  draft.watch(name + ".force");
}

void add_lugre(Draft &draft, const Link &link)
{
  const std::string name = begin_element(draft, link, "bristle", "lugre friction");
  lossy(draft);
  nonlinear(draft);
  draft.machine.bdf_only = true;
  const double stiffness = link.scale.stiffness() * draft.dice.log_between(10., 300.);
  const double force     = draft.number("kinetic_force", link.scale.force() * draft.dice.log_between(0.03, 0.5));
  if (draft.dice.chance(0.7))
  {
    draft.number("static_force", force * draft.dice.between(1., 2.));
    draft.number("stribeck_speed", link.scale.speed() * draft.dice.log_between(0.03, 1.));
  }
  draft.number("bristle_stiffness", stiffness);
  if (draft.dice.chance(0.6))
    draft.number("bristle_damping", std::sqrt(stiffness * link.scale.mass) * draft.dice.log_between(0.01, 1.));
  draft.watch(name + ".force");
}

} // namespace gestell::tests
