#include "apps/analysis/spectra/spectrum_values.h"
#include "apps/output/report/section.h"
#include "apps/output/values/result.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gestell::apps
{

namespace
{

double most_of(const SignalSpectrum &spectrum)
{
  return *std::max_element(spectrum.amplitudes.begin(), spectrum.amplitudes.end());
}

constexpr double shown_power = 0.99; ///< of each signal: the axis of frequencies ends there

/// The line up to which a signal has that share of its power, the sum of its squared amplitudes.
std::size_t last_line(const SignalSpectrum &spectrum)
{
  const auto   power = [](double sum, double amplitude) { return sum + amplitude * amplitude; };
  const auto  &all   = spectrum.amplitudes;
  const double most  = shown_power * std::accumulate(all.begin() + 1, all.end(), 0., power);
  std::size_t  k     = 1;
  for (double sum = power(0., all[k]); sum < most && k + 1 < all.size(); sum = power(sum, all[k]))
    ++k;
  return k;
}

/// [Hz] where the axis of frequencies ends.
double highest_shown(const Spectra &spectra, const std::vector<const SignalSpectrum *> &shown)
{
  std::size_t last = std::min<std::size_t>(8, shown.front()->amplitudes.size() - 1); // fewer lines make no curve
  for (const SignalSpectrum *spectrum : shown)
    last = std::max(last, last_line(*spectrum));
  return static_cast<double>(last) * spectra.resolution_hz;
}

/// [Hz] of a drive with constant speed; 0: there is none.
double drive_hz(const std::optional<OrderTracking> &orders)
{
  if (!orders || orders->speed_rpm.empty())
    return 0.;
  const auto [low, high] = std::minmax_element(orders->speed_rpm.begin(), orders->speed_rpm.end());
  // largest to smallest speed: the 8th order is smeared by 16 % of the speed at most
  constexpr double steady = 1.02;
  return *low > 0. && *high <= steady * *low ? 0.5 * (*low + *high) / 60. : 0.;
}

void add_marks(const Result &result, const std::optional<OrderTracking> &orders, Chart &chart)
{
  int number = 0;
  for (const coupling::Mode &mode : result.coupled_modes)
    if (++number; mode.frequency_hz > 0. && mode.frequency_hz < chart.x.end)
      chart.marks.push_back(
          {mode.frequency_hz, "mode " + std::to_string(number) + ": " + short_text(mode.frequency_hz) + " Hz", number});
  const double  drive         = drive_hz(orders);
  constexpr int marked_orders = 8; // further ones lie closer than their labels
  for (int order = 1; order <= marked_orders && drive > 0. && order * drive < chart.x.end; ++order)
    chart.marks.push_back(
        {order * drive,
         "order " + std::to_string(order) + " of " + orders->rotor + ": " + short_text(order * drive) + " Hz", 0, 1});
}

Chart spectrum_chart(const Result &result, const RunSpectra &found, const std::vector<const SignalSpectrum *> &shown)
{
  const Spectra &spectra = *found.spectra;
  double         most    = 0.;
  for (const SignalSpectrum *spectrum : shown)
    most = std::max(most, most_of(*spectrum));
  const DisplayUnit unit = display_unit(shown.front()->unit, most);
  Chart             chart;
  chart.width  = 880.;
  chart.height = 280.;
  chart.title  = "Spectrum";
  for (const SignalSpectrum *spectrum : shown)
    chart.title += (spectrum == shown.front() ? ": " : ", ") + spectrum->name;
  chart.x    = {"frequency [Hz]", 0., highest_shown(spectra, shown)};
  chart.note = percent(shown_power) + " of the power of " + (shown.size() > 1 ? "each signal" : "the signal") +
               " is below " + short_text(chart.x.end, 3) + " Hz, the end of the chart";
  // relative to the largest amplitude: 80 dB, the leakage of the window a few bins away from a line
  constexpr double least_shown = 1e-4;
  chart.y       = {"amplitude [" + unit.unit + "]", least_shown * most * unit.factor, 2. * most * unit.factor};
  chart.y.scale = Scale::logarithmic;
  for (const SignalSpectrum *spectrum : shown)
  {
    Curve curve{spectrum->name};
    for (std::size_t k = 1; k < spectrum->amplitudes.size(); ++k)
      curve.add(static_cast<double>(k) * spectra.resolution_hz, spectrum->amplitudes[k] * unit.factor);
    chart.panels[0].add(std::move(curve));
  }
  add_marks(result, found.orders, chart);
  return chart;
}

/// Signals of one unit share a chart.
std::vector<std::vector<const SignalSpectrum *>> by_unit(const Spectra &spectra)
{
  std::vector<std::vector<const SignalSpectrum *>> groups;
  for (const SignalSpectrum &spectrum : spectra.signals)
  {
    if (!(most_of(spectrum) > 0.))
      continue;
    const auto same =
        std::find_if(groups.begin(), groups.end(), [&](const auto &group) { return group[0]->unit == spectrum.unit; });
    if (same == groups.end())
      groups.push_back({&spectrum});
    else
      same->push_back(&spectrum);
  }
  return groups;
}

/// Up to which frequency the rows of the history carry the signals, and up to which one lines are drawn.
std::string rows_text(const Spectra &spectra)
{
  const double listed_hz = static_cast<double>(spectra.signals.front().amplitudes.size() - 1) * spectra.resolution_hz;
  return "History rows are " + short_text(spectra.row_step, 3) + " s apart and resolve frequencies up to " +
         short_text(spectra.carried_hz, 3) + " Hz" +
         (listed_hz < 0.999 * spectra.carried_hz ? " (listed up to " + short_text(listed_hz, 3) + " Hz)" : "") +
         ". Rows are samples, not averages: faster motion is aliased to frequencies below " +
         short_text(0.5 / spectra.row_step, 3) + " Hz; to resolve it, reduce output.step.";
}

} // namespace

Section spectrum_section(const Result &result, const RunSpectra &found)
{
  const Spectra &spectra = *found.spectra;
  Section        section{"spectrum", "Spectra", "Spectra", Section::Place::history, true};
  section.parts.push_back(Section::Sentences{
      "Amplitudes over the run, " + short_text(spectra.begin) + " to " + short_text(spectra.end) +
      " s, in one Hann window with " + std::to_string(spectra.samples) + " samples. Lines are " +
      short_text(spectra.resolution_hz, 3) +
      " Hz apart; frequencies closer than twice this distance are not separated. Numbers: modes of the coupled "
      "machine" +
      (drive_hz(found.orders) > 0. ? "; ticks: orders of " + found.orders->rotor : "") + ". " + rows_text(spectra)});
  int number = 0;
  for (const auto &group : by_unit(spectra))
    section.parts.push_back(Section::Drawing{"spectrum" + (++number == 1 ? "" : "-" + std::to_string(number)),
                                             spectrum_chart(result, found, group)});
  if (number == 0)
    section.parts.clear();
  return section;
}

} // namespace gestell::apps
