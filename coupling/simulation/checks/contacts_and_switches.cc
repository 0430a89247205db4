#include "coupling/simulation/checks/contacts_and_switches.h"

#include "coupling/machine/element_law.h"
#include "mechanism/elements/coulomb_friction.h"

#include <algorithm>
#include <sstream>

namespace gestell::coupling
{

namespace
{

bool happened(const std::vector<Event> &events, const ActiveGuard &guard)
{
  return std::any_of(events.begin(), events.end(),
                     [&](const Event &event) { return event.name == guard.name && event.kind == guard.kind; });
}

/// Whether a switch on time is intended to act at the start of the run.
bool at_the_start(const Switch &own, double begin)
{
  return own.signal == "t" && own.level == begin;
}

const Switch *switch_called(const Machine &machine, const std::string &name)
{
  const auto &all   = machine.model().switches();
  const auto  found = std::find_if(all.begin(), all.end(), [&](const Switch &own) { return own.name == name; });
  return found == all.end() ? nullptr : &*found;
}

/// A limit that nobody wants to be reached.
bool ends_the_run(const Machine &machine, const std::string &name)
{
  const Switch *own = switch_called(machine, name);
  return own && !own->ends.empty();
}

} // namespace

void check_switches(const Machine &machine, double begin, const std::vector<Event> &events, RunOutcome &outcome)
{
  for (const Event &event : events)
    if (event.kind == "switch" && event.t == begin &&
        std::none_of(machine.model().switches().begin(), machine.model().switches().end(),
                     [&](const Switch &own) { return own.name == event.name && at_the_start(own, begin); }))
      outcome.warn("switch-at-start", event.name,
                   "switch " + event.name + " triggered at the start: its signal had already reached the threshold");
  if (!outcome.reached_end())
    return;
  for (int i = 0; i < machine.events().n_guards(); ++i)
    if (const ActiveGuard guard = machine.events().guard(i);
        guard.kind == "switch" && !happened(events, guard) && !ends_the_run(machine, guard.name))
      outcome.warn("switch-never-thrown", guard.name,
                   "switch " + guard.name + " never triggered: its signal did not reach the threshold");
}

std::string end_by_switch(const Machine &machine, double begin, const Event &event)
{
  const Switch *own = switch_called(machine, event.name);
  if (!own || own->ends.empty() || event.kind != (own->delay > 0. ? "orders" : "switch"))
    return "";
  std::ostringstream text;
  text << (event.t == begin ? "at the start, t = " : "at t = ") << event.t << " s, " << own->ends << ": " << own->signal
       << (own->crossing == SwitchCrossing::rising    ? " is above "
           : own->crossing == SwitchCrossing::falling ? " is below "
                                                      : " passes ")
       << own->level << ", where switch \"" << own->name << "\" ends the run";
  return text.str();
}

void check_closed_contacts(const Machine &machine, const InitialState &initial, RunOutcome &outcome)
{
  LocalState local;
  machine.gather(initial.t, initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), local);
  for (const std::string &contact : machine.closed_contacts(local))
    outcome.warn("contact-at-start", contact,
                 "the initial state penetrates the contact of " + contact +
                     ", which pushes at once. If this is not intended, change the position or the clearance, or use "
                     "start.rule = \"static\"");
}

void check_unlocated_friction(const Machine &machine, RunOutcome &outcome)
{
  for (const ElementPlacement &placement : machine.model().elements())
    if (law_of<mechanism::CoulombFriction>(placement))
      return outcome.warn("friction-without-events", placement.name,
                          "run.events = false, but the dry friction of \"" + placement.name +
                              "\" needs located events: without them its force may exceed its limit, or chatter; set "
                              "run.events = true, or use the type \"friction\"");
}

} // namespace gestell::coupling
