#include "coupling/recorder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double nearby  = 0.25; ///< a parabola errs by about that share of its length about a peak at its end
constexpr double brief   = 1e-9; ///< share of the step before: what lasts shorter lies within the resolution of events
constexpr double on_grid = 1e-9; ///< share of the grid's step within which an instant is a point of it

struct Point
{
  double t, f;
};

/// Vertex of the parabola through three points of ascending t, if it is a maximum in (a, c) or nearby outside.
bool maximum(const Point &a, const Point &b, const Point &c, Point &top)
{
  const double rise = (b.f - a.f) / (b.t - a.t), curvature = ((c.f - b.f) / (c.t - b.t) - rise) / (c.t - a.t);
  if (!(curvature < 0.))
    return false;
  top.t               = 0.5 * (a.t + b.t) - 0.5 * rise / curvature;
  top.f               = a.f + (top.t - a.t) * (rise + curvature * (top.t - b.t));
  const double margin = nearby * (c.t - a.t);
  return top.t > a.t - margin && top.t < c.t + margin;
}

std::string method_and_step(const MethodOptions &method)
{
  std::ostringstream text;
  text << method_name(method) << " with a ";
  if (method.tolerance > 0.)
    text << "tolerance of " << method.tolerance;
  else
    text << "step of " << method.step << " s";
  return text.str();
}

/// What keeps more of the energy than the method does.
std::string remedy(const MethodOptions &method, EnergyGuard::Verdict verdict)
{
  if (method.tolerance > 0.)
    return "; take a smaller tolerance";
  if (verdict == EnergyGuard::Verdict::no_motion)
    return "; take a smaller step, or method = \"bdf\" with a tolerance, which finds its steps itself";
  return method.method == Method::bdf && method.order < 4
             ? "; take a smaller step. Where bodies spin or swing many times, order = 4 with 60 steps or more per turn "
               "loses far less"
             : "; take a smaller step";
}

/// The balance must not err more than the integrator.
PowerRule power_rule(const MethodOptions &method)
{
  const bool high_order =
      method.tolerance > 0. || (method.method == Method::exact && method.force == ForceRule::collocation);
  return high_order ? PowerRule::gauss : PowerRule::trapezoidal;
}

} // namespace

std::vector<int> coordinates_of(const std::vector<Signal> &signals)
{
  std::set<int> coordinates;
  for (const Signal &signal : signals)
    for (const Measure *measure : {&signal.on_q, &signal.on_v})
      for (const auto &term : *measure) // a weight of zero: the signal reads the coordinate otherwise
        coordinates.insert(term.first);
  return {coordinates.begin(), coordinates.end()};
}

std::optional<Accelerations> accelerations_for(const std::vector<Signal> &signals, const SecondOrderSystem &system)
{
  for (const Signal &signal : signals)
    if (signal.reads_acceleration())
      return Accelerations(system);
  return {};
}

Recorder::Recorder(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
                   const std::vector<Signal> &signals, int samples, RunResult &result)
    : machine_(machine), integrator_(integrator), options_(options), signals_(signals), result_(result),
      keeper_(integrator, options.states, options.begin, result.signals, result.states), energy_(machine),
      coordinates_(coordinates_of(signals)), accelerations_(accelerations_for(signals, machine)),
      row_step_(output_step(options)), picture_step_(options.picture_step)
{
  between_.q.setZero(machine.size());
  between_.v.setZero(machine.size());
  between_.local.resize(machine);
  probe_   = {0., std::vector<double>(signals.size())};
  earlier_ = probe_;
  samples_.assign(samples + 1, probe_);
  watched_.assign(signals.size(), true);
  anew_.assign(signals.size(), true);

  result.columns = {"t"};
  result.units   = {"s"};
  for (const Signal &signal : signals)
  {
    result.signals.push_back({signal.name, signal.unit});
    result.columns.push_back(signal.name);
    result.units.push_back(signal.unit);
  }
  if (options.energy)
    for (const char *name : {"energy input", "energy stored", "energy dissipated"})
    {
      result.columns.push_back(name);
      result.units.push_back("J");
    }
  const double length = options.end - options.begin;
  result.rows.reserve(static_cast<std::size_t>(length / row_step_ + 3.) * result.columns.size());
  if (picture_step_ > 0.)
    result.picture_states.reserve(static_cast<std::size_t>(length / picture_step_ + 2.));
}

void Recorder::evaluate(double t, Sample &sample)
{
  const bool at_end = t == integrator_.time();
  if (!at_end)
    integrator_.interpolate(t, between_.local);
  tell(t, at_end ? integrator_.local() : between_.local, sample);
}

/// @param local  the motion of the measures at t
void Recorder::tell(double t, const LocalState &local, Sample &sample)
{
  if (accelerations_)
    a_ = accelerations_->at(t, integrator_, local, between_.q, between_.v);
  else if (!coordinates_.empty())
    integrator_.motion_at(t, coordinates_, between_.q, between_.v);
  sample.t = t;
  for (std::size_t i = 0; i < signals_.size(); ++i)
    sample.values[i] = machine_.evaluate(signals_[i], between_.q, between_.v, a_, local);
}

void Recorder::begin()
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    watched_[i] = signals_[i].from.empty();
  if (options_.energy)
  {
    energy_.begin(integrator_.instant());
    guard_ = EnergyGuard(energy_.at_begin());
  }
  behind_  = integrator_.local();
  pending_ = true;
  pictures();
  keeper_.follow();
}

/// The motion behind the last event, at which the last step began or where there is none yet.
void Recorder::settle()
{
  pending_       = false;
  earlier_known_ = false;
  tell(behind_.t, behind_, samples_.back());
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (anew_[i])
    {
      look_anew(i);
      anew_[i] = false;
    }
  extremes(samples_.back());
  if (next_row_ == 0)
  {
    row(behind_.t, samples_.back(), result_.energy);
    next_row_ = 1;
  }
}

void Recorder::step()
{
  const double begin = integrator_.step_begin(), end = integrator_.time();
  if (!(end > begin))
    return;
  if (pending_ && end - begin < brief * length_)
  {
    follow_briefly();
    return;
  }
  length_ = end - begin;
  if (pending_)
    settle();
  const auto n = static_cast<int>(samples_.size()) - 1;
  if (n == 1)
    std::swap(earlier_, samples_[0]);
  std::swap(samples_[0], samples_[n]);
  for (int k = 1; k <= n; ++k)
  {
    evaluate(k == n ? end : begin + (end - begin) * k / n, samples_[k]);
    extremes(samples_[k]);
  }
  if (n == 1 && earlier_known_)
    turn(earlier_, samples_[0], samples_[1]);
  else if (n == 1)
  {
    evaluate(0.5 * (begin + end), earlier_);
    extremes(earlier_);
    turn(samples_[0], earlier_, samples_[1]);
  }
  for (int k = 1; k < n; ++k)
    turn(samples_[k - 1], samples_[k], samples_[k + 1]);
  earlier_known_ = true;
  if (options_.energy)
    balance();
  rows();
  pictures();
  keeper_.follow();
}

/// A step between two events at one instant.
void Recorder::follow_briefly()
{
  behind_ = integrator_.local();
  if (options_.energy)
    balance();
}

/// Extremes of a signal count from here.
void Recorder::look_anew(std::size_t signal)
{
  SignalSummary &summary = result_.signals[signal];
  summary.min = summary.max = samples_.back().values[signal];
  summary.t_min = summary.t_max = samples_.back().t;
}

void Recorder::jump(const std::string &event)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    if (!watched_[i] && signals_[i].from == event)
      watched_[i] = anew_[i] = true;
  if (options_.energy)
    energy_.jump(integrator_.instant());
  behind_  = integrator_.local();
  pending_ = true;
}

void Recorder::extremes(const Sample &sample)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    extreme(i, sample.t, sample.values[i]);
}

void Recorder::extreme(std::size_t signal, double t, double value)
{
  SignalSummary &summary = result_.signals[signal];
  if (!watched_[signal])
    return;
  if (value < summary.min)
  {
    summary.min   = value;
    summary.t_min = t;
  }
  if (value > summary.max)
  {
    summary.max   = value;
    summary.t_max = t;
  }
}

/// Looks for extremes beyond those seen about three successive samples, inside the last step.
void Recorder::turn(const Sample &a, const Sample &b, const Sample &c)
{
  for (std::size_t i = 0; i < signals_.size(); ++i)
    for (const double sign : {-1., 1.})
    {
      const SignalSummary &summary = result_.signals[i];
      Point                top;
      if (!watched_[i])
        continue;
      const bool turns = maximum({a.t, sign * a.values[i]}, {b.t, sign * b.values[i]}, {c.t, sign * c.values[i]}, top);
      if (turns && top.f > (sign > 0. ? summary.max : -summary.min))
        search(i, sign, a, b, c);
    }
}

/// The maximum of sign * signal on the dense output, by parabolas that close in on it.
void Recorder::search(std::size_t signal, double sign, const Sample &a, const Sample &b, const Sample &c)
{
  std::array<Point, 3> p = {
      {{a.t, sign * a.values[signal]}, {b.t, sign * b.values[signal]}, {c.t, sign * c.values[signal]}}};
  const double close = 1e-6 * (c.t - a.t);
  Point        top;
  for (int k = 0; k < 8 && maximum(p[0], p[1], p[2], top); ++k)
  {
    if (top.t < samples_.front().t)
      return; // in the step before, where it was looked for
    // A peak that seems to lie outside is looked for at the end, from inside.
    if (top.t >= p[2].t)
      top.t = 0.25 * p[1].t + 0.75 * p[2].t;
    else if (top.t <= p[0].t)
      top.t = 0.25 * p[1].t + 0.75 * p[0].t;
    const bool found = std::any_of(p.begin(), p.end(), [&](const Point &x) { return std::abs(x.t - top.t) < close; });
    if (found)
      return;
    evaluate(top.t, probe_);
    top.f = sign * probe_.values[signal];
    extremes(probe_);
    // The end that is farther away gives place.
    p[top.t - p[0].t > p[2].t - top.t ? 0 : 2] = top;
    std::sort(p.begin(), p.end(), [](const Point &x, const Point &y) { return x.t < y.t; });
  }
}

void Recorder::rows()
{
  const double end = integrator_.time();
  for (double t; (t = options_.begin + double(next_row_) * row_step_) <= end + on_grid * row_step_; ++next_row_)
  {
    if (t >= end - on_grid * row_step_)
    {
      row(t, samples_.back(), result_.energy);
      continue;
    }
    evaluate(std::max(t, integrator_.step_begin()), probe_);
    extremes(probe_);
    row(t, probe_, options_.energy ? energy_inside(probe_.t) : result_.energy);
  }
}

/// At t in the last step, where evaluate() was last.
EnergySummary Recorder::energy_inside(double t)
{
  between_.t = t;
  integrator_.interpolate(t, between_.q, between_.v);
  const EnergyState energy = energy_.state(between_);
  return {energy.input, energy.stored, energy.dissipated};
}

void Recorder::row(double t, const Sample &sample, const EnergySummary &energy)
{
  result_.rows.push_back(t);
  result_.rows.insert(result_.rows.end(), sample.values.begin(), sample.values.end());
  if (options_.energy)
    result_.rows.insert(result_.rows.end(), {energy.input, energy.stored, energy.dissipated});
}

void Recorder::pictures()
{
  if (!(picture_step_ > 0.))
    return;
  const double end = integrator_.time();
  for (double t; (t = options_.begin + double(next_picture_) * picture_step_) <= end + on_grid * picture_step_;
       ++next_picture_)
  {
    result_.picture_times.push_back(t);
    if (t >= end - on_grid * picture_step_)
    {
      result_.picture_states.push_back(integrator_.instant().q);
      continue;
    }
    integrator_.interpolate(std::max(t, integrator_.step_begin()), between_.q, between_.v);
    result_.picture_states.push_back(between_.q);
  }
}

void Recorder::balance()
{
  energy_.step(integrator_, power_rule(options_.method));
  const Instant    &now    = integrator_.instant();
  const EnergyState energy = energy_.state(now);
  guard_.step(energy, now.q.size() > 0 ? now.q.cwiseAbs().maxCoeff() : 0.);
  result_.energy = {energy.input, energy.stored, energy.dissipated, guard_.residual(), guard_.exchanged()};
}

void Recorder::finish()
{
  if (pending_)
    settle();
  const Sample &last = samples_.back();
  if (result_.rows.empty() || result_.rows[result_.rows.size() - result_.columns.size()] < last.t - on_grid * row_step_)
    row(integrator_.time(), last, result_.energy);
  for (std::size_t i = 0; i < signals_.size(); ++i)
  {
    result_.signals[i].final = last.values[i];
    if (watched_[i])
      continue;
    result_.warnings.push_back("signal " + signals_[i].name + " is watched from the event \"" + signals_[i].from +
                               "\" on, which did not happen: its extremes are those of the end");
    look_anew(i);
  }
  const EnergyGuard::Verdict verdict = guard_.verdict();
  if (verdict == EnergyGuard::Verdict::closed)
    return;
  const std::string words = guard_.words(method_and_step(options_.method)) + remedy(options_.method, verdict);
  if (verdict == EnergyGuard::Verdict::open || options_.force_unstable || !result_.failure.empty())
    result_.warnings.push_back(words);
  else
    result_.failure = words;
}

} // namespace gestell::coupling
