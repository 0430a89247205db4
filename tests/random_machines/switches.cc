#include "tests/random_machines/laws.h"

#include <algorithm>

namespace gestell::tests
{
namespace
{

bool ends_in(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// What is off obeys no law.
void forget_laws(RandomMachine &machine, const std::string &element)
{
  for (FrictionFact &fact : machine.frictions)
    if (fact.name == element)
      fact.engaged = false;
}

/// Of a signal of the motion; some are never reached.
void condition(Draft &draft, const std::string &signal, bool again)
{
  static const char *const ways[] = {"above", "below", "crosses"};
  const double             size   = size_of(draft.machine, signal);
  draft.text("when", signal);
  draft.number(ways[draft.dice.whole(3)], size * draft.dice.sign() * draft.dice.log_between(0.02, 1.));
  if (draft.dice.chance(0.3))
    draft.number("delay", draft.machine.period * draft.dice.log_between(0.01, 0.5));
  if (!again)
    return;
  draft.line("repeat = true");
  draft.number("hysteresis", size * draft.dice.log_between(0.05, 0.5));
}

} // namespace

void add_switches(Draft &draft)
{
  RandomMachine           &machine = draft.machine;
  std::vector<std::string> motions;
  for (const std::string &signal : machine.signals)
    for (const char *quantity : {".displacement", ".velocity", ".angle", ".speed", ".ux", ".ux_rate"})
      if (ends_in(signal, quantity))
        motions.push_back(signal);
  if (motions.empty() || draft.elements.empty())
    return;
  const auto        &elements = draft.elements;
  const std::string &element  = elements[draft.dice.whole(int(elements.size()))];
  const auto         motion   = [&] { return motions[draft.dice.whole(int(motions.size()))]; };
  forget_laws(machine, element);
  machine.conservative = machine.linear = false;
  machine.passive                       = false; // what is on again brings the energy it has then
  const std::string off                 = draft.new_name("switch");
  draft.table("switch." + off);
  const bool again = draft.dice.chance(0.4);
  condition(draft, motion(), again);
  draft.text("tell", element);
  draft.text("order", "off");
  if (!draft.dice.chance(0.6))
    return;
  draft.table("switch." + draft.new_name("switch"));
  draft.text("after", off);
  condition(draft, motion(), again);
  draft.text("tell", element);
  draft.text("order", "on");
}

} // namespace gestell::tests
