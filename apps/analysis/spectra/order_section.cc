#include "apps/analysis/spectra/spectrum_values.h"
#include "apps/output/report/section.h"
#include "apps/output/values/result.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{

/// of the largest amplitude of a signal, that an order has to reach: a pixel or two of its chart
constexpr double seen = 1e-2;

double largest(const std::vector<double> &amplitudes)
{
  return *std::max_element(amplitudes.begin(), amplitudes.end());
}

double largest(const OrderedSignal &signal)
{
  double most = 0.;
  for (const std::vector<double> &order : signal.amplitudes)
    most = std::max(most, largest(order));
  return most;
}

/// A speed that hardly changes is drawn over the time.
bool over_speed(const OrderTracking &tracking)
{
  const auto [low, high] = std::minmax_element(tracking.speed_rpm.begin(), tracking.speed_rpm.end());
  return *high > 1.02 * *low;
}

Chart order_chart(const OrderTracking &tracking, const OrderedSignal &signal)
{
  const bool        speed = over_speed(tracking);
  const DisplayUnit unit  = display_unit(signal.unit, largest(signal));
  Chart             chart;
  chart.width   = 880.;
  chart.height  = 220.;
  chart.title   = signal.name + ": orders of " + tracking.rotor;
  chart.x.label = speed ? "speed [1/min]" : "t [s]";
  chart.y.label = "amplitude [" + unit.unit + "]";
  chart.y.begin = 0.;
  for (std::size_t k = 0; k < tracking.orders.size(); ++k)
  {
    if (largest(signal.amplitudes[k]) < seen * largest(signal))
      continue;
    Curve curve;
    curve.name = "order " + std::to_string(tracking.orders[k]);
    curve.x    = speed ? tracking.speed_rpm : tracking.t;
    for (const double amplitude : signal.amplitudes[k])
      curve.y.push_back(amplitude * unit.factor);
    chart.panels[0].add(curve);
  }
  return chart;
}

/// [Hz] to where there is something to see, with some room.
double highest_seen(const Waterfall &spectra, double most)
{
  std::size_t last = 0;
  for (const std::vector<double> &row : spectra.amplitudes)
    for (std::size_t i = last; i < row.size(); ++i)
      if (row[i] > seen * most)
        last = i;
  return std::min(spectra.frequencies_hz.back(), 1.5 * spectra.frequencies_hz[last]);
}

/// Spectra one above the other at the height of their speed, with the lines of the orders and of natural frequencies.
Chart waterfall_chart(const Waterfall &spectra, const std::vector<coupling::Mode> &modes)
{
  Chart        chart;
  const double span = spectra.speed_rpm.back() - spectra.speed_rpm.front(), fastest = spectra.speed_rpm.back();
  double       most = 0.;
  for (const std::vector<double> &row : spectra.amplitudes)
    most = std::max(most, largest(row));
  const DisplayUnit unit = display_unit(spectra.unit, most);
  chart.width            = 880.;
  chart.height           = 420.;
  chart.title            = spectra.name + ": spectra over the speed";
  chart.note =
      "highest amplitude " + short_text(most * unit.factor) + " " + unit.unit + "; dashed: orders of the speed";
  chart.x.label            = "frequency [Hz]";
  chart.y.label            = "speed [1/min]";
  chart.x.begin            = 0.;
  chart.x.end              = highest_seen(spectra, most);
  chart.y.begin            = spectra.speed_rpm.front() - 0.05 * span;
  constexpr double tallest = 0.25; // height of a spectrum, relative to the range of speeds: only adjacent ones overlap
  chart.y.end              = fastest + tallest * span;
  for (std::size_t i = spectra.amplitudes.size(); i-- > 0;) // the lowest in front
  {
    Curve curve;
    curve.x = spectra.frequencies_hz;
    for (const double amplitude : spectra.amplitudes[i])
      curve.y.push_back(spectra.speed_rpm[i] + tallest * span * amplitude / most);
    chart.panels[0].curves.push_back(curve);
  }
  for (const int order : {1, 2, 3, 4, 5, 6, 7, 8})
  {
    Curve line;
    line.colour = 1;
    line.line   = LineStyle::dashed;
    line.add(order * chart.y.begin / 60., chart.y.begin);
    line.add(order * chart.y.end / 60., chart.y.end);
    chart.panels[0].curves.push_back(line);
  }
  int number = 0;
  for (const coupling::Mode &mode : modes)
    if (++number; mode.frequency_hz > 0. && mode.frequency_hz < chart.x.end)
      chart.marks.push_back({mode.frequency_hz,
                             "mode " + std::to_string(number) + ": " + short_text(mode.frequency_hz) + " Hz", number,
                             0});
  return chart;
}

} // namespace

Section order_section(const Result &result, const OrderTracking &tracking)
{
  Section section{"orders", "Orders of the speed of " + tracking.rotor, "Orders", Section::Place::history, true};
  section.parts.push_back(Section::Sentences{"Signals resampled over the angle of " + tracking.rotor +
                                             ", in windows of " + std::to_string(tracking.turns) +
                                             " revolutions: vibration at multiples of its speed."});
  HtmlTable   table({"signal", "#order", "#largest amplitude", "unit", "#speed [1/min]", "#time [s]"});
  std::size_t drawn = 0;
  for (const OrderedSignal &signal : tracking.signals)
  {
    if (!(largest(signal) > 0.))
      continue;
    constexpr std::size_t most_signals = 8; // that are drawn; the table has all
    if (++drawn <= most_signals)
      section.parts.push_back(Section::Drawing{"orders-" + std::to_string(drawn), order_chart(tracking, signal),
                                               over_speed(tracking) ? ChartLink::none : ChartLink::time});
    for (const Waterfall &spectra : tracking.waterfalls)
      if (spectra.name == signal.name && spectra.amplitudes.size() > 1 && drawn <= most_signals)
        section.parts.push_back(Section::Drawing{"waterfall-" + std::to_string(drawn),
                                                 waterfall_chart(spectra, result.coupled_modes), ChartLink::none,
                                                 Section::Drawing::Shown::picture});
    for (std::size_t k = 0; k < tracking.orders.size(); ++k)
      if (const auto &order = signal.amplitudes[k]; largest(order) >= seen * largest(signal))
      {
        const auto        at   = std::size_t(std::max_element(order.begin(), order.end()) - order.begin());
        const DisplayUnit unit = display_unit(signal.unit, order[at]);
        table.add({signal.name, std::to_string(tracking.orders[k]), short_text(order[at] * unit.factor), unit.unit,
                   short_text(tracking.speed_rpm[at], 5), short_text(tracking.t[at], 5)});
      }
  }
  section.parts.push_back(table);
  if (drawn == 0)
    section.parts.clear();
  return section;
}

} // namespace gestell::apps
