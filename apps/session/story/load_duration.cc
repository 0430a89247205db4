#include "apps/session/story/load_duration.h"

#include "apps/session/history_rows.h"
#include "mechanism/facets.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr double acts = 0.01; ///< of the peak: what noise and other loads leave is below

/// Whether |F| reaches a share of the peak.
class Above
{
public:
  Above(const std::vector<double> &F, double peak) : F_(F), peak_(std::abs(peak)) {}

  bool operator()(std::size_t i, double share) const { return std::abs(F_[i]) >= share * peak_; }

private:
  const std::vector<double> &F_;
  double                     peak_;
};

std::size_t first_of_piece(const Above &above, std::size_t i)
{
  while (i > 0 && above(i - 1, acts))
    --i;
  return i;
}

/// Goes back over short gaps.
std::size_t begin_of_load(const Above &above, const std::vector<double> &t, std::size_t peak, double end)
{
  std::size_t begin = first_of_piece(above, peak);
  for (;;)
  {
    std::size_t before = begin;
    while (before > 0 && !above(before - 1, acts))
      --before;
    constexpr double short_gap = 0.1; // of the duration after it: a chattering contact is one load
    if (before == 0 || t[begin] - t[before - 1] > short_gap * (end - t[begin]))
      return begin;
    begin = first_of_piece(above, before - 1);
  }
}

bool changes_sign(const std::vector<double> &F, double peak)
{
  const double other = peak > 0. ? *std::min_element(F.begin(), F.end()) : *std::max_element(F.begin(), F.end());
  return peak * other < 0. && std::abs(other) > acts * std::abs(peak);
}

/// w . v of the single measure of an element; nan of several.
double moved(const coupling::ElementPlacement &placement, const coupling::Mode &mode)
{
  if (placement.measures.size() != 1)
    return std::numeric_limits<double>::quiet_NaN();
  double u = 0.;
  for (const auto &[i, weight] : placement.measures.front())
    u += weight * mode.shape[i];
  return u;
}

LoadOnMode on_mode(const LoadDuration &load, const coupling::ElementPlacement &placement, const LocalModes &there,
                   std::size_t j)
{
  const coupling::Mode &mode = there.modes[j];
  const double          f    = mode.frequency_hz;
  LoadOnMode            on{there.numbers[j], f, (load.t_fall - load.begin) * f, load.rise * f, load.fall * f, 0.};
  on.fall_factor = fall_factor(on.fall);
  on.energy      = 0.5 * std::pow(on.fall_factor * moved(placement, mode) * load.peak / (2. * M_PI * f), 2);
  on.strain      = there.strain(j);
  return on;
}

void add_modes(const coupling::ElementPlacement &placement, const LocalModes &there, int most, LoadDuration &load)
{
  load.t_modes                     = there.t;
  load.place                       = there.place;
  load.unknown                     = there.unknown;
  constexpr double      slow       = 100.; // times the duration: slower modes see an impulse
  constexpr double      fast       = 4.;   // periods within the fall: its factor is below 0.1 beyond
  constexpr std::size_t most_modes = 12;   // rows of a table
  for (std::size_t j = 0; j < std::min(there.modes.size(), std::size_t(most)) && load.modes.size() < most_modes; ++j)
    if (const double f = there.modes[j].frequency_hz;
        f * slow * (load.t_fall - load.begin) > 1. && f * load.fall < fast)
      load.modes.push_back(on_mode(load, placement, there, j));
}

/// The stored state closest to the start of the fall, in it or within a tenth of the load's duration; none: empty q.
coupling::KeptState state_at_fall(const LoadDuration &load, const coupling::RunResult &run)
{
  const double        reach = std::max(load.fall, 0.1 * (load.t_fall - load.begin));
  coupling::KeptState nearest;
  double              away = reach;
  const auto          take = [&](double t, const Eigen::VectorXd &q)
  {
    if (q.size() == 0 || std::abs(t - load.t_fall) > away)
      return;
    away    = std::abs(t - load.t_fall);
    nearest = {t, q};
  };
  for (const auto &states : run.states.around)
    for (const coupling::KeptState &state : states)
      take(state.t, state.q);
  for (std::size_t i = 0; i < run.picture_states.size(); ++i)
    take(run.picture_times[i], run.picture_states[i]);
  return nearest;
}

/// Samples of a signal: rows, and between them the values on both sides of located events, where a tool breaks through.
struct Samples
{
  std::vector<double> t, F;

  void add(double at, double value)
  {
    t.push_back(at);
    F.push_back(value);
  }
};

Samples samples_of(const coupling::RunResult &run, std::size_t s)
{
  const HistoryRows rows(run);
  Samples           samples;
  std::size_t       e          = 0;
  const auto        add_events = [&](double until)
  {
    for (; e < run.event_values.size() && run.event_values[e].t < until; ++e)
      if (const coupling::EventValues &at = run.event_values[e];
          !at.before.empty() && !at.after.empty() && !samples.t.empty() && at.t > samples.t.back())
      {
        samples.add(at.t, at.before[s]);
        samples.add(at.t, at.after[s]);
      }
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    add_events(rows.t(i));
    samples.add(rows.t(i), rows.at(i, s + 1));
  }
  return samples;
}

double largest_gap(const std::vector<double> &t, double begin, double end)
{
  double gap = 0.;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (t[i] > begin && t[i - 1] < end)
      gap = std::max(gap, t[i] - t[i - 1]);
  return gap;
}

} // namespace

bool is_tool(const mechanism::Element &element)
{
  if (!element.force_law() || element.work() == mechanism::Work::input)
    return false;
  const auto          k = std::size_t(element.n_measures());
  std::vector<double> u(k, 0.), K(k * k, 0.), D(k * k, 0.);
  mechanism::engaged(element, u.data(), K.data(), D.data());
  const auto zero = [](double x) { return x == 0.; };
  return std::all_of(K.begin(), K.end(), zero) && std::all_of(D.begin(), D.end(), zero);
}

double fall_factor(double fall_over_period)
{
  const double x = M_PI * fall_over_period;
  return x < 1e-8 ? 1. : std::abs(std::sin(x) / x);
}

std::optional<LoadDuration> load_duration(const std::vector<double> &t, const std::vector<double> &F)
{
  if (F.size() < 3)
    return {};
  const auto largest =
      std::max_element(F.begin(), F.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const std::size_t peak = std::size_t(largest - F.begin()), n = F.size();
  const Above       above(F, *largest);
  if (*largest == 0. || changes_sign(F, *largest))
    return {};
  constexpr double high = 0.9; // of the peak: rise and fall between 10 and 90 %, as usual
  constexpr double low  = 0.1; // of the peak
  std::size_t      end = peak, fall = peak, down = peak;
  while (end + 1 < n && above(end, acts))
    ++end;
  while (down + 1 < n && above(down, low))
    fall = above(down, high) ? down : fall, ++down;
  const std::size_t begin = begin_of_load(above, t, peak, t[end]);
  if (begin == 0 || above(end, acts))
    return {};
  std::size_t risen = begin;
  while (!above(risen, high))
    ++risen;
  LoadDuration load;
  load.begin    = t[begin];
  load.end      = t[end];
  load.peak     = *largest;
  load.t_peak   = t[peak];
  load.rise     = t[risen] - t[begin];
  load.t_fall   = t[fall];
  load.fall     = (t[down] - t[fall]) / (high - low);
  load.row_step = largest_gap(t, load.begin, load.end);
  return load;
}

std::vector<LoadDuration> load_durations(const std::vector<coupling::Signal> &signals, const coupling::Machine &machine,
                                         const Result &result, ModesOfRun &modes)
{
  std::vector<LoadDuration> loads;
  for (std::size_t s = 0; s < signals.size(); ++s)
  {
    const coupling::Signal &signal = signals[s];
    if (signal.element < 0 || (signal.unit != "N" && signal.unit != "N m"))
      continue;
    const coupling::ElementPlacement &placement = machine.model().elements()[std::size_t(signal.element)];
    if (!is_tool(*placement.element))
      continue;
    const Samples samples = samples_of(*result.run, s);
    if (auto load = load_duration(samples.t, samples.F))
    {
      load->signal  = signal.name;
      load->element = placement.name;
      load->unit    = signal.unit;
      if (const coupling::KeptState state = state_at_fall(*load, *result.run); state.q.size() == machine.size())
        add_modes(placement, modes.at(state), modes.most(), *load);
      else
        load->unknown = "no state was stored near the end of the load";
      loads.push_back(*load);
    }
  }
  return loads;
}

} // namespace gestell::apps
