#include "coupling/machine_parts.h"
#include "coupling/nearest_name.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

/// Carries the motion of a signal into u, so that it is known wherever events are looked for; acts with no force.
class Watch : public mechanism::ForceElement
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

void Machine::add_switch(const Switch &request)
{
  signal(request.name, request.signal); // throws with the nearest name
  std::vector<std::string> names;
  for (const ElementPlacement &element : parts_->elements)
  {
    names.push_back(element.name);
    if (element.name != request.element)
      continue;
    const auto orders = element.element->commands();
    if (std::find(orders.begin(), orders.end(), request.order) == orders.end())
      throw std::invalid_argument(
          "\"" + request.element + "\" knows no order \"" + request.order + "\"" +
          (orders.empty() ? std::string("; it obeys none") : suggestion(request.order, orders)));
    parts_->switch_requests.push_back(request);
    return;
  }
  throw std::invalid_argument("there is no element \"" + request.element + "\"" + suggestion(request.element, names));
}

/// Elements of no force for switches whose signal is a motion: its measures, or the two sums on q and q'.
void Machine::Parts::add_watches()
{
  switches.clear();
  for (const Switch &request : switch_requests)
  {
    PlacedSwitch own;
    own.request = request;
    own.signal  = signal(request.name, request.signal);
    if (own.signal.element >= 0)
      own.watched = own.signal.element;
    else
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

void Machine::Parts::place_switches()
{
  for (PlacedSwitch &own : switches)
  {
    const auto target =
        std::find_if(elements.begin(), elements.end(),
                     [&](const ElementPlacement &element) { return element.name == own.request.element; });
    own.target  = static_cast<int>(target - elements.begin());
    own.history = static_cast<int>(history.size());
    history.conservativeResize(history.size() + 1);
    history[own.history] = 0.;
  }
}

double Machine::Parts::watched_value(const PlacedSwitch &own, const LocalState &state) const
{
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

bool Machine::wants_multipliers() const
{
  const auto watches_joint = [&](const Parts::PlacedSwitch &own)
  { return own.signal.element >= 0 && parts_->placed[own.watched].tells_multipliers(own.signal.quantity); };
  // What sticks in a joint holds as long as its limit, which follows from multipliers, lets it.
  const auto sticks_in_joint = [](const Parts::PlacedElement &part)
  { return part.holds && part.first_multiplier >= 0; };
  return parts_->reads_joints || std::any_of(parts_->placed.begin(), parts_->placed.end(), sticks_in_joint) ||
         std::any_of(parts_->switches.begin(), parts_->switches.end(), watches_joint);
}

void Machine::will_read(const std::vector<Signal> &signals)
{
  const auto reads_joint = [&](const Signal &signal)
  { return signal.element >= 0 && parts_->placed[signal.element].tells_multipliers(signal.quantity); };
  parts_->reads_joints = std::any_of(signals.begin(), signals.end(), reads_joint);
}

bool Machine::forces_need_multipliers() const
{
  return std::any_of(parts_->elements.begin(), parts_->elements.end(),
                     [](const ElementPlacement &placement) { return placement.joint >= 0; });
}

const NamedMeasure &Machine::measure(const std::string &name) const
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
