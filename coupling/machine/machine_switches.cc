#include "coupling/machine/machine.h"
#include "coupling/machine/machine_parts.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Copies the motion of a signal into u, so that it is available for event location; exerts no force.
class Watch : public mechanism::ForceLaw
{
public:
  explicit Watch(int n_measures) : n_measures_(n_measures) {}

  int  n_measures() const override { return n_measures_; }
  void force(const mechanism::LocalMotion &, const double *, double *p) const override
  {
    std::fill(p, p + n_measures_, 0.);
  }
  void tangent(const mechanism::LocalMotion &motion, const double *history, const mechanism::TangentWeights &,
               double *p, double *dp) const override
  {
    force(motion, history, p);
    std::fill(dp, dp + n_measures_ * n_measures_, 0.);
  }
  std::vector<mechanism::Quantity> quantities() const override { return {}; }
  double quantity(int, const mechanism::LocalMotion &, const double *) const override { return 0.; }

private:
  int n_measures_;
};

} // namespace

/// @throws std::invalid_argument with the most similar name, or for a signal that does not allow event location
Signal MachineParts::watched_signal(const Switch &request) const
{
  try
  {
    Signal watched = signal(request.signal);
    if (!watched.on_q.empty()) // a force of the frame: without the inertia beyond its modes, which is not continuous
      watched.on_a.clear();
    if (watched.reads_acceleration())
      throw std::invalid_argument("\"" + request.signal +
                                  "\" is an acceleration, which cannot trigger a switch; use a force or a velocity");
    return watched;
  }
  catch (const std::invalid_argument &unfit)
  {
    throw std::invalid_argument(std::string("when: ") + unfit.what());
  }
}

void MachineModel::add_switch(const Switch &request)
{
  parts_->watched_signal(request);
  std::vector<std::string> names;
  for (const ElementPlacement &element : parts_->elements)
    names.push_back(element.name);
  for (const auto &[name, order] : request.orders)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw std::invalid_argument("there is no element \"" + name + "\"" + suggestion(name, names));
    const auto &element = *parts_->elements[found - names.begin()].element;
    const auto  known   = command_names(element);
    if (std::find(known.begin(), known.end(), order.name) == known.end())
      throw std::invalid_argument("\"" + name + "\" does not accept the command \"" + order.name + "\"" +
                                  (known.empty() ? std::string("; it accepts none") : suggestion(order.name, known)));
    element.commands()->check_order(order);
  }
  parts_->switch_requests.push_back(request);
}

/// Elements of no force for switches whose signal is a motion: its measures, or the two sums on q and q'.
void MachineParts::add_watches()
{
  switches.clear();
  for (const Switch &request : switch_requests)
  {
    PlacedSwitch own;
    own.request = request;
    own.signal  = watched_signal(request);
    if (own.signal.element >= 0)
      own.watched = own.signal.element;
    else if (own.signal.on_t == 0.)
    {
      own.watched         = static_cast<int>(elements.size());
      const auto watching = own.signal.measure >= 0 ? measures[own.signal.measure].measures
                                                    : std::vector<Measure>{own.signal.on_q, own.signal.on_v};
      elements.push_back(
          {"switch " + request.name, std::make_shared<Watch>(static_cast<int>(watching.size())), watching});
    }
    switches.push_back(own);
  }
}

namespace
{
enum Slot
{
  phase_slot,
  due_slot,
  side_slot, ///< -1: the signal is below the level, or treated so, until it rises above; 1: above; 0: not known yet
  n_slots
};
} // namespace

void MachineParts::place_switches()
{
  for (PlacedSwitch &own : switches)
  {
    for (const SwitchOrder &order : own.request.orders)
    {
      const auto target = std::find_if(elements.begin(), elements.end(),
                                       [&](const ElementPlacement &element) { return element.name == order.element; });
      own.targets.push_back(static_cast<int>(target - elements.begin()));
    }
    for (std::size_t i = 0; i < switches.size(); ++i)
      if (!own.request.after.empty() && switches[i].request.name == own.request.after)
        own.after = static_cast<int>(i);
    if (!own.request.after.empty() && own.after < 0)
      throw std::invalid_argument("switch \"" + own.request.name + "\": there is no switch \"" + own.request.after +
                                  "\" to wait for");
    own.history = static_cast<int>(history.size());
    history.conservativeResize(history.size() + n_slots);
  }
  start_switches(nullptr);
}

void MachineParts::start_switches(const LocalState *state)
{
  for (const PlacedSwitch &own : switches)
  {
    history[own.history + due_slot] = 0.;
    watch(own, state);
    if (own.after >= 0)
      history[own.history + phase_slot] = double(SwitchPhase::waits);
  }
}

/// Arms the switch.  A crossing in either direction starts from the present side of the signal; if this is unknown, or
/// the signal is exactly at the level, the next accepted instant decides.
/// @param state  null: not known
void MachineParts::watch(const PlacedSwitch &own, const LocalState *state)
{
  history[own.history + phase_slot] = double(SwitchPhase::watches);
  double &side                      = history[own.history + side_slot];
  side                              = own.request.crossing == SwitchCrossing::rising    ? -1.
                                      : own.request.crossing == SwitchCrossing::falling ? 1.
                                                                                        : 0.;
  if (side != 0. || !state || (own.signal.element >= 0 && tells_found_force(own)))
    return;
  const double past = watched_value(own, *state) - own.request.level;
  side              = past < 0. ? -1. : past > 0. ? 1. : 0.;
}

/// Whether the signal follows from forces that follow from the step's equations, not from a law: unknown at a start.
bool MachineParts::tells_found_force(const PlacedSwitch &own) const
{
  double      rate = 0.;
  const auto &part = placed[own.watched];
  return part.tells_multipliers(own.signal.quantity) || part.sticks(history_of(part), rate);
}

void MachineParts::find_sides(const LocalState &state)
{
  bool found = false;
  for (const PlacedSwitch &own : switches)
    if (phase(own) == SwitchPhase::watches && history[own.history + side_slot] == 0.)
    {
      const double past                = watched_value(own, state) - own.request.level;
      history[own.history + side_slot] = past < 0. ? -1. : past > 0. ? 1. : 0.;
      found                            = found || history[own.history + side_slot] != 0.;
    }
  if (found)
    refresh_guards();
}

MachineParts::SwitchPhase MachineParts::phase(const PlacedSwitch &own) const
{
  return static_cast<SwitchPhase>(static_cast<int>(history[own.history + phase_slot]));
}

bool MachineParts::is_active(const PlacedSwitch &own) const
{
  return phase(own) != SwitchPhase::waits && phase(own) != SwitchPhase::rests;
}

GuardCrossing MachineParts::switch_crossing(const PlacedSwitch &own) const
{
  const bool either = own.request.crossing == SwitchCrossing::either, back = phase(own) == SwitchPhase::returns;
  if (phase(own) == SwitchPhase::delays || (either && back))
    return GuardCrossing::rising;
  return (history[own.history + side_slot] <= 0.) != back ? GuardCrossing::rising : GuardCrossing::falling;
}

std::string MachineParts::switch_event(const PlacedSwitch &own) const
{
  return phase(own) == SwitchPhase::delays ? "orders" : phase(own) == SwitchPhase::returns ? "ready" : "switch";
}

double MachineParts::switch_guard(const PlacedSwitch &own, const LocalState &state) const
{
  if (phase(own) == SwitchPhase::delays)
    return state.t - history[own.history + due_slot];
  const double side = history[own.history + side_slot];
  if (phase(own) == SwitchPhase::watches && side == 0.)
    return -1.; // a rising one is not past it
  const double past = watched_value(own, state) - own.request.level;
  if (phase(own) == SwitchPhase::watches)
    return past;
  if (own.request.crossing == SwitchCrossing::either)
    return std::abs(past) - own.request.hysteresis;
  return past - side * own.request.hysteresis;
}

/// Executes the event of the switch: crossing, end of the delay, or return.
void MachineParts::throw_switch(int index, const LocalState &state)
{
  const PlacedSwitch &own  = switches[index];
  double             &next = history[own.history + phase_slot];
  switch (phase(own))
  {
  case SwitchPhase::watches:
    if (own.request.delay > 0.)
    {
      next                            = double(SwitchPhase::delays);
      history[own.history + due_slot] = state.t + own.request.delay;
      return;
    }
    give_orders(index, state);
    return;
  case SwitchPhase::delays:
    give_orders(index, state);
    return;
  case SwitchPhase::returns:
    watch(own, &state);
    return;
  case SwitchPhase::waits:
  case SwitchPhase::rests:
    return;
  }
}

void MachineParts::give_orders(int index, const LocalState &state)
{
  const PlacedSwitch &own  = switches[index];
  double             &next = history[own.history + phase_slot], &side = history[own.history + side_slot];
  const bool          at_level = phase(own) == SwitchPhase::watches;
  next                         = double(own.request.repeat ? SwitchPhase::returns : SwitchPhase::rests);
  if (own.request.repeat && own.request.crossing == SwitchCrossing::either && own.request.hysteresis == 0.)
  {
    if (at_level) // rounding must not decide the side
      next = double(SwitchPhase::watches), side = -side;
    else
      watch(own, &state);
  }
  for (std::size_t i = 0; i < own.targets.size(); ++i)
  {
    const PlacedElement &target = placed[own.targets[i]];
    const SwitchOrder   &given  = own.request.orders[i];
    try
    {
      target.commands->command(given.order, target.motion(state, by_history), history_of(target));
    }
    catch (const std::domain_error &beyond) // the law cannot be continued
    {
      std::ostringstream message;
      message << "at t = " << state.t << " s, switch \"" << own.request.name << "\" commands \"" << given.element
              << "\": " << beyond.what();
      throw ConvergenceFailure(message.str());
    }
  }
  for (const PlacedSwitch &other : switches)
    if (other.after == index && phase(other) == SwitchPhase::waits)
      watch(other, &state);
}

double MachineParts::watched_value(const PlacedSwitch &own, const LocalState &state) const
{
  if (own.signal.on_t != 0.)
    return own.signal.scale * own.signal.on_t * state.t;
  const PlacedElement &part   = placed[own.watched];
  const auto           motion = part.motion(state, by_history);
  double               value  = own.signal.offset;
  if (own.signal.element >= 0)
    value += part.element->quantity(own.signal.quantity, motion, history_of(part));
  else if (own.signal.measure >= 0)
  {
    double     gradient[mechanism::CombinedMeasure::max_measures];
    const auto measured = measures[own.signal.measure].measure.evaluate(motion.u, motion.v, gradient);
    value += own.signal.quantity == 0 ? measured.s : measured.rate;
  }
  else
    value += motion.u[0] + motion.v[1];
  if (own.signal.load >= 0)
    value += loads[own.signal.load].at(state.t);
  return own.signal.scale * value;
}

void Machine::will_read(const std::vector<Signal> &signals)
{
  const std::function<bool(const Signal &)> reads_joint = [&](const Signal &signal)
  {
    return (signal.reads_acceleration() && !parts_->joints.empty()) ||
           (signal.element >= 0 && parts_->placed[signal.element].tells_multipliers(signal.quantity)) ||
           (signal.computed && std::any_of(signal.computed->of.begin(), signal.computed->of.end(), reads_joint));
  };
  parts_->reads_joints = std::any_of(signals.begin(), signals.end(), reads_joint);
}

const NamedMeasure &MachineModel::measure(const std::string &name) const
{
  std::vector<std::string> names;
  for (const NamedMeasure &measure : parts_->measures)
  {
    if (measure.name == name)
      return measure;
    names.push_back(measure.name);
  }
  throw std::invalid_argument("there is no measure \"" + name + "\"" + suggestion(name, names));
}

} // namespace gestell::coupling
