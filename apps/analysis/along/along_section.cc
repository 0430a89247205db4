#include "apps/analysis/along/along_section.h"

#include "apps/output/charts/mode_charts.h"
#include "apps/output/values/line_extremes.h"
#include "apps/output/values/result.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::apps
{
namespace
{

using coupling::ModesAlong;
using coupling::ModesAt;

/// The coordinate as shown: angles in degrees.
DisplayUnit shown_unit(const ModesAlong &modes)
{
  if (modes.coordinate.unit == "rad")
    return {180. / M_PI, "°"};
  double largest = 0.;
  for (const ModesAt &at : modes.positions)
    largest = std::max(largest, std::abs(at.x));
  return display_unit(modes.coordinate.unit, largest);
}

std::string at_text(const ModesAlong &modes, double x)
{
  const DisplayUnit unit = shown_unit(modes);
  return short_text(x * unit.factor, 5) + (unit.unit == "°" ? "" : " ") + unit.unit;
}

std::vector<double> frequencies(const ModesAlong &modes, std::size_t line)
{
  std::vector<double> f;
  for (const ModesAt &at : modes.positions)
    f.push_back(line < at.modes.size() ? at.modes[line].frequency_hz : std::nan(""));
  return f;
}

/// Lines with a frequency somewhere, sorted by their largest one, in groups that share a chart; lines that lose their
/// frequency somewhere, such as a drive that weights stabilise here and drive away there, come last.
std::vector<std::vector<std::size_t>> groups(const ModesAlong &modes)
{
  std::vector<std::size_t> lines;
  for (std::size_t i = 0; i < modes.free.size(); ++i)
    if (line_extremes(modes, i).max > 0.)
      lines.push_back(i);
  const auto key = [&](std::size_t i)
  {
    const LineExtremes own = line_extremes(modes, i);
    return std::pair(own.min == 0., own.max);
  };
  std::stable_sort(lines.begin(), lines.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<std::vector<std::size_t>> all;
  double                                lowest = 0.;
  bool                                  lost   = false;
  for (const std::size_t i : lines)
  {
    const LineExtremes own          = line_extremes(modes, i);
    constexpr double   widest_chart = 3.; // highest to lowest frequency: bends of lower ones stay a third as high
    if (all.empty() || own.max > widest_chart * lowest || std::exchange(lost, own.min == 0.) != (own.min == 0.) ||
        int(all.back().size()) == n_series_colours)
    {
      all.emplace_back();
      lowest = own.max;
    }
    lowest = std::min(lowest, std::max(own.min, own.max / widest_chart));
    all.back().push_back(i);
  }
  return all;
}

std::string meeting_text(const AlongResult &along, const coupling::OrderMeeting &meeting)
{
  return "order " + std::to_string(meeting.order) + " is close to line " + std::to_string(meeting.line + 1) + " at " +
         at_text(along.modes, meeting.x) + ", " + short_text(meeting.frequency_hz, 5) + " Hz";
}

void add_orders(const AlongResult &along, const std::vector<std::size_t> &lines, Chart &chart)
{
  const double f_0 = along.speed / (2. * M_PI), factor = shown_unit(along.modes).factor;
  for (int k = 1; f_0 > 0. && k <= along.orders; ++k)
    if (k * f_0 > chart.y.begin && k * f_0 < chart.y.end)
      chart.levels.push_back({k * f_0, std::to_string(k) + " Ω"});
  Curve met = rings("", 5);
  for (const coupling::OrderMeeting &meeting : along.meetings)
    if (std::find(lines.begin(), lines.end(), std::size_t(meeting.line)) != lines.end())
    {
      met.add(meeting.x * factor, meeting.frequency_hz);
      met.notes.push_back({meeting_text(along, meeting)});
    }
  chart.panels[0].curves.push_back(met);
}

/// Multiples of 5, 15, 30 or 90 degrees.
std::vector<double> degree_ticks(double low, double high)
{
  std::vector<double> ticks;
  for (const double step : {5., 15., 30., 90., 360.})
    if ((high - low) / step <= 12.5)
    {
      for (double x = step * std::ceil(low / step - 1e-9); x <= high + 1e-9 * step; x += step)
        ticks.push_back(x);
      break;
    }
  return ticks;
}

/// Sets the height for the curves and for orders close to them, with a margin so that constant values look flat.
void set_height(const AlongResult &along, const std::vector<std::size_t> &lines, Chart &chart)
{
  double low = std::numeric_limits<double>::infinity(), high = 0.;
  for (const std::size_t i : lines)
  {
    const LineExtremes own = line_extremes(along.modes, i);
    low                    = std::min(low, own.min);
    high                   = std::max(high, own.max);
  }
  const double f_0 = along.speed / (2. * M_PI), l = low, h = high;
  for (int k = 1; f_0 > 0. && k <= along.orders; ++k)
    if (k * f_0 > l / (1. + 2. * along.band) && k * f_0 < h * (1. + 2. * along.band))
    {
      low  = std::min(low, k * f_0);
      high = std::max(high, k * f_0);
    }
  constexpr double least_span = 0.1; // least span of the axis, relative to its middle
  const double     middle = 0.5 * (low + high), half = std::max(0.55 * (high - low), 0.5 * least_span * middle);
  chart.y.begin = std::max(0., middle - half);
  chart.y.end   = middle + half;
}

HtmlTable line_table(const AlongResult &along)
{
  HtmlTable table({"#line", "#lowest frequency [Hz]", "#position", "#highest frequency [Hz]", "#position",
                   "#lowest damping ratio", "#highest damping ratio", "#smallest MAC",
                   "dominant DOF at the first position"});
  for (std::size_t i = 0; i < along.modes.free.size(); ++i)
  {
    const LineExtremes own  = line_extremes(along.modes, i);
    const std::string  line = std::to_string(i + 1), &moves = along.modes.moves_most[i];
    if (along.modes.free[i])
    {
      table.add({line, "–", "–", "–", "–", "–", "–", short_text(own.least_assurance, 3),
                 moves + "; unconstrained, zero frequency"});
      continue;
    }
    table.add({line, short_text(own.min, 6), at_text(along.modes, own.x_min), short_text(own.max, 6),
               at_text(along.modes, own.x_max), short_text(own.least_damping, 3), short_text(own.largest_damping, 3),
               short_text(own.least_assurance, 3),
               moves + (own.growth > 0. ? "; unstable at " + at_text(along.modes, own.x_growth) + ", grows by exp(" +
                                              short_text(own.growth, 3) + " t/s)"
                                        : "")});
  }
  return table;
}

void add_meetings(const AlongResult &along, std::vector<Section::Part> &parts)
{
  using Part = Section::Sentences;
  if (!(along.speed > 0.))
  {
    parts.push_back(
        Part{"The speed is unknown, so orders are not compared. Set it, for example with --speed \"30 1/min\".", true,
             true});
    return;
  }
  const std::string orders = "of " + short_text(along.speed * 30. / M_PI, 5) + " 1/min",
                    within = "within " + short_text(100. * along.band, 3) + " % of a frequency";
  if (along.meetings.empty())
  {
    parts.push_back(
        Part{"None of the orders 1 to " + std::to_string(along.orders) + " " + orders + " is " + within + "."});
    return;
  }
  HtmlTable table({"#order", "#line", "#from", "#to", "#closest at", "#frequency [Hz]", "#distance"});
  for (const coupling::OrderMeeting &meeting : along.meetings)
    table.add({std::to_string(meeting.order), std::to_string(meeting.line + 1), at_text(along.modes, meeting.begin),
               at_text(along.modes, meeting.end), at_text(along.modes, meeting.x), short_text(meeting.frequency_hz, 5),
               short_text(100. * meeting.distance, 2) + " %"});
  parts.push_back(Part{"Orders " + orders + " " + within + " (rings in the charts):"});
  parts.push_back(table);
}

/// Shapes of the lines that change most, where their frequencies are lowest and highest.
void add_shapes(const Result &result, const ModesAlong &modes, std::vector<Section::Part> &parts)
{
  std::vector<std::size_t> lines;
  const auto               change = [&](std::size_t i)
  {
    const LineExtremes own = line_extremes(modes, i);
    return own.min > 0. ? own.max / own.min - 1. : 0.;
  };
  constexpr double seen_change = 0.02; // least change of a frequency for which shapes are drawn
  for (std::size_t i = 0; i < modes.free.size(); ++i)
    if (change(i) > seen_change)
      lines.push_back(i);
  std::stable_sort(lines.begin(), lines.end(), [&](std::size_t a, std::size_t b) { return change(a) > change(b); });
  constexpr std::size_t most_shapes = 4; // a row of pictures each
  lines.resize(std::min(lines.size(), most_shapes));
  if (!lines.empty())
    parts.push_back(Section::Sentences{"Mode shapes at the lowest and highest frequency of each line:", true});
  for (const std::size_t i : lines)
    for (const bool highest : {false, true})
    {
      const LineExtremes own = line_extremes(modes, i);
      for (const ModesAt &at : modes.positions)
        if (i < at.modes.size() && at.x == (highest ? own.x_max : own.x_min))
        {
          const std::string title = "Line " + std::to_string(i + 1) + " at " + at_text(modes, at.x) + ": " +
                                    short_text(at.modes[i].frequency_hz) + " Hz";
          parts.push_back(Section::Picture{"shape-along-" + std::to_string(i + 1) + (highest ? "-highest" : "-lowest"),
                                           shape_svg(result, title, at.modes[i])});
        }
    }
}

std::string statement(const AlongResult &along)
{
  long deflected = 0, undeformed = 0;
  for (const ModesAt &at : along.modes.positions)
    if (at.gap.empty())
      ++(at.configuration == coupling::Configuration::equilibrium ? deflected : undeformed);
  std::string text = "Machine linearised at " + std::to_string(deflected + undeformed) + " positions of " +
                     along.modes.coordinate.name + ": ";
  if (deflected > 0)
    text += std::to_string(deflected) + " in static equilibrium" + (undeformed > 0 ? ", " : "");
  if (undeformed > 0)
    text += std::to_string(undeformed) + " undeformed";
  text += along.geometric == coupling::GeometricStiffness::included ? "; with" : "; without";
  text += " geometric stiffness. Tool forces and drives are switched off. ";
  text += !along.fixed.empty()                ? "Fixed: " + along.fixed + "."
          : along.modes.coordinate.joint >= 0 ? "The driven joint has constant length in the linearised machine."
                                              : "The coordinate is free at each position.";
  return text + " Each line follows one mode shape by the mass-weighted modal assurance criterion (MAC).";
}

/// Frequencies of some lines over the coordinate.
Chart along_chart(const AlongResult &along, const std::vector<std::size_t> &lines)
{
  const DisplayUnit unit = shown_unit(along.modes);
  Chart             chart;
  chart.width   = 880.;
  chart.height  = 290.;
  chart.title   = "Natural frequencies along " + along.modes.coordinate.name;
  chart.x.label = along.modes.coordinate.name + " [" + unit.unit + "]";
  chart.y.label = "frequency [Hz]";
  std::vector<double> x;
  for (const ModesAt &at : along.modes.positions)
    x.push_back(at.x * unit.factor);
  for (const std::size_t i : lines)
    chart.panels[0].add({"line " + std::to_string(i + 1), x, frequencies(along.modes, i)});
  if (const auto [low, high] = std::minmax(x.front(), x.back()); unit.unit == "°")
    chart.x.ticks = degree_ticks(low, high);
  set_height(along, lines, chart);
  add_orders(along, lines, chart);
  return chart;
}

} // namespace

std::vector<Section> sections_of(const Result &result, const AlongResult &along)
{
  Section     section{"along", "Natural frequencies along " + along.modes.coordinate.name, "Frequencies along",
                  Section::Place::frequencies};
  auto       &parts = section.parts;
  std::size_t n     = 0;
  parts.push_back(Section::Sentences{statement(along), true});
  for (const std::vector<std::size_t> &lines : groups(along.modes))
    parts.push_back(
        Section::Drawing{"modes-along" + (++n > 1 ? "-" + std::to_string(n) : ""), along_chart(along, lines)});
  add_meetings(along, parts);
  parts.push_back(line_table(along));
  add_shapes(result, along.modes, parts);
  return {section};
}

} // namespace gestell::apps
