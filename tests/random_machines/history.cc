#include "tests/random_machines/history.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::tests
{
namespace
{
constexpr double finest = 1e-8; ///< tolerance to which anything is judged

/// Of fixed steps, fifty in the fastest period: inside them forces and accelerations are straight lines, which miss
/// (omega h)^2/8 of a swing, while what is told of extremes comes from the ends.
constexpr double linear_inside = (2. * M_PI / 50.) * (2. * M_PI / 50.) / 8.;

bool is_force_like(const std::string &signal)
{
  const std::string quantity = signal.substr(signal.rfind('.') + 1);
  return quantity == "acceleration" || quantity == "force" || quantity == "torque";
}

std::string at_time(const std::string &what, double t)
{
  std::ostringstream text;
  text.precision(12);
  text << what << " at t = " << t;
  return text.str();
}
} // namespace

History::History(const RandomMachine &machine, const std::string &way, const Told &dense, const Told &summary,
                 double tolerance)
    : machine_(machine), way_(way), dense_(dense), summary_(summary), accurate_(tolerance > 0.),
      tolerance_(std::max(tolerance, finest))
{
}

std::vector<Finding> History::judge()
{
  finite();
  if (!findings_.empty())
    return findings_;
  extremes();
  frictions();
  contacts();
  joints();
  energy();
  return findings_;
}

void History::find(const std::string &kind, const std::string &what, double value, double bound)
{
  findings_.push_back({kind, way_, what, value, bound});
}

void History::finite()
{
  for (int i = 0; i < dense_.n_rows(); ++i)
    for (std::size_t j = 0; j < dense_.run.columns.size(); ++j)
      if (!std::isfinite(dense_.at(i, int(j))))
        return find("not finite", at_time(dense_.run.columns[j], dense_.at(i, 0)), dense_.at(i, int(j)), 0.);
  for (const coupling::SignalSummary &signal : summary_.run.signals)
    if (!std::isfinite(signal.min + signal.max + signal.final))
      return find("not finite", signal.name + " in the summary", signal.max, 0.);
}

double History::range(int column) const
{
  double low = dense_.at(0, column), high = low;
  for (int i = 1; i < dense_.n_rows(); ++i)
  {
    low  = std::min(low, dense_.at(i, column));
    high = std::max(high, dense_.at(i, column));
  }
  return high - low;
}

/// The place of a pin, where it may rest.
bool History::held(const std::string &signal) const
{
  const std::string place = signal.substr(0, signal.rfind('.'));
  return std::any_of(machine_.pins.begin(), machine_.pins.end(),
                     [&](const PinFact &pin) { return pin.a == place || pin.b == place; });
}

void History::extremes()
{
  for (const coupling::SignalSummary &signal : summary_.run.signals)
  {
    const int column = dense_.column(signal.name);
    if (held(signal.name))
      continue; // may rest: joints() judges it
    extreme(column, 1., signal.max, signal.t_max);
    extreme(column, -1., signal.min, signal.t_min);
  }
}

/// A phase from one event to another, shorter than two rows are apart, begins or ends at t.
bool History::between_rows(double t) const
{
  const double apart = 2. * dense_.at(1, 0), same = 1e-12 * machine_.end;
  const auto   near = [&](double from, double to)
  {
    return std::any_of(summary_.run.events.begin(), summary_.run.events.end(),
                       [&](const coupling::Event &event) { return event.t >= from && event.t <= to; });
  };
  return near(t - same, t + same) ? near(t + same, t + apart) || near(t - apart, t - same)
                                  : near(t - apart, t) && near(t, t + apart);
}

/// The maximum of sign * signal, against the largest row, and against the rows beside it and what the motion may do
/// between two rows.
void History::extreme(int column, double sign, double reported, double t_told)
{
  const int  n     = dense_.n_rows();
  const auto value = [&](int i) { return sign * dense_.at(std::clamp(i, 0, n - 1), column); };
  int        top   = 0;
  for (int i = 1; i < n; ++i)
    if (value(i) > value(top))
      top = i;
  const std::string &name     = dense_.run.columns[column];
  const double       size     = std::max(range(column), at_rest * size_of(machine_, name));
  const double       t        = dense_.at(top, 0);
  const std::string  what     = at_time(std::string(sign > 0. ? "max" : "min") + " of " + name, t);
  const double       short_of = !accurate_ && is_force_like(name) ? linear_inside : 1e-4;
  if (sign * reported < value(top) - short_of * size)
    find("extreme short of the history", what, reported, sign * value(top));

  // On either side of a jump the signal goes on as on its own side.
  const int nearby = int(t_told / dense_.at(1, 0));
  double    step   = 0.;
  for (int i = nearby - 2; i <= nearby + 3; ++i)
    step = std::max(step, std::min(std::abs(value(i) - value(i - 1)), std::abs(value(i + 1) - value(i))));
  const double beyond = sign * reported - std::max(value(nearby), value(nearby + 1));
  const double noise  = (accurate_ ? 1e-6 : 1e-4) * size + tolerance_ * size_of(machine_, name);
  if (beyond > 2. * step + noise && !between_rows(t_told))
    find(beyond_history, at_time(what + ", told", t_told), reported, sign * value(nearby));
}

void History::frictions()
{
  for (const FrictionFact &fact : machine_.frictions)
  {
    const int    force = dense_.column(fact.name + ".force"), rate = dense_.column(fact.name + ".rate");
    const double none = (accurate_ ? std::max(1e-6, tolerance_) : 1e-5) * fact.holding; // of forces that are solved for
    Finding      worst{"friction above its limit", way_, "", 0., 0.}, off{"friction off its law", way_, "", 0., 0.};
    for (int i = 0; i < dense_.n_rows(); ++i)
    {
      const double v = dense_.at(i, rate) - fact.belt, F = dense_.at(i, force);
      const double limit = fact.holding + fact.viscous * std::abs(v);
      if (std::abs(F) - limit > std::max(none, worst.value - worst.bound))
        worst = {worst.kind, way_, at_time(fact.name, dense_.at(i, 0)), std::abs(F), limit};
      if (!fact.engaged || std::abs(v) < 1e-3 * machine_.speed)
        continue;
      const double falling =
          fact.stribeck_speed > 0. ? std::exp(-std::pow(std::abs(v) / fact.stribeck_speed, fact.exponent)) : 0.;
      const double law = std::copysign(fact.sliding + (fact.holding - fact.sliding) * falling, v) + fact.viscous * v;
      if (std::abs(F - law) > std::max(1e-5 * fact.holding, std::abs(off.value - off.bound)))
        off = {off.kind, way_, at_time(fact.name, dense_.at(i, 0)), F, law};
    }
    for (const Finding &finding : {worst, off})
      if (!finding.what.empty())
        findings_.push_back(finding);
    for (const coupling::SignalSummary &signal : summary_.run.signals)
      if (signal.name == fact.name + ".force")
      {
        double fastest = 0.;
        for (int i = 0; i < dense_.n_rows(); ++i)
          fastest = std::max(fastest, std::abs(dense_.at(i, rate) - fact.belt));
        const double most = std::max(signal.max, -signal.min), limit = fact.holding + fact.viscous * fastest * 1.01;
        if (most > limit + none)
          find("friction above its limit", "extreme of " + fact.name, most, limit);
      }
  }
}

void History::contacts()
{
  if (!accurate_ && dense_.run.work.chatter > 0)
    return; // a step that goes over more events than are located has the force of its formula
  for (const ContactFact &fact : machine_.contacts)
  {
    const int    force = dense_.column(fact.name + ".force"), motion = dense_.column(fact.name + ".displacement");
    const double size = std::max(range(force), at_rest * machine_.force);
    Finding      worst{"contact pulls", way_, "", 0., 0.};
    for (int i = 0; i < dense_.n_rows(); ++i)
    {
      const double side = fact.side ? fact.side : std::copysign(1., dense_.at(i, motion));
      if (const double pull = -side * dense_.at(i, force);
          pull > std::max((accurate_ ? tolerance_ : 1e-6) * size, worst.value))
        worst = {worst.kind, way_, at_time(fact.name, dense_.at(i, 0)), pull, 0.};
    }
    if (!worst.what.empty())
      findings_.push_back(worst);
  }
}

void History::joints()
{
  for (const PinFact &pin : machine_.pins)
    for (const char axis : pin.axes)
    {
      const std::string end = std::string(".") + axis;
      const int         a = dense_.column(pin.a + end), b = dense_.column(pin.b + end);
      double            gap = 0., t = 0.;
      for (int i = 0; i < dense_.n_rows(); ++i)
      {
        const double place = a < 0 ? pin.x[axis - 'x'] : dense_.at(i, a);
        if (const double g = std::abs(place - dense_.at(i, b)); g > gap)
        {
          gap = g;
          t   = dense_.at(i, 0);
        }
      }
      const double bound = (accurate_ ? 1e-6 : 1e-3) * pin.size; // of the dense output between two steps
      if (gap > bound)
        find("joint open", at_time(pin.joint + " along " + axis, t), gap, bound);
    }
}

/// No body moves but by rounding.
bool History::rests() const
{
  for (const coupling::SignalSummary &signal : dense_.run.signals)
    if (const std::string last = signal.name.substr(signal.name.rfind('.') + 1); last == "velocity" || last == "speed")
      if (std::max(signal.max, -signal.min) > tolerance_ * size_of(machine_, signal.name))
        return false;
  return true;
}

void History::energy()
{
  if (rests())
    return;
  const auto  &energy = dense_.run.energy;
  const double size   = std::max(energy.exchanged, at_rest * at_rest * machine_.force * machine_.length);
  // Each step may err by its tolerance.  Of what drives feed into each other through a prescribed motion nothing is
  // exchanged, but it is as right as their forces alone.
  double way = 0.;
  for (const coupling::SignalSummary &signal : dense_.run.signals)
    if (const std::string last = signal.name.substr(signal.name.rfind('.') + 1);
        last == "displacement" || last == "angle")
      way = std::max(way, signal.max - signal.min);
  const double open =
      std::max(1e-3, tolerance_ * double(dense_.run.work.steps)) * size + tolerance_ * machine_.force * way;
  if (accurate_ && energy.residual > open)
    find("energy open", "residual", energy.residual, open);
  const int dissipated = dense_.column("energy dissipated"), input = dense_.column("energy input");
  double    most = 0., back = 0., t = 0.;
  for (int i = 0; i < dense_.n_rows(); ++i)
  {
    const double now = dense_.at(i, dissipated);
    most             = std::max(most, now);
    if (most - now > back)
    {
      back = most - now;
      t    = dense_.at(i, 0);
    }
  }
  const double share = accurate_ ? 1e-4 : 1e-2;
  if (machine_.passive && back > share * size)
    find("dissipation falls", at_time("dissipated", t), back, share * size);
  if (!machine_.conservative)
    return;
  if (most > share * size)
    find("loss of a conservative machine", "dissipated", most, share * size);
  if (range(input) > 0.)
    find("input of a conservative machine", "input", range(input), 0.);
}

} // namespace gestell::tests
