#include "apps/output/report/frequency_response_report.h"

#include "apps/output/interactive/live_chart.h"
#include "apps/output/tables/frequency_response_table.h"
#include "apps/output/text/html.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

namespace
{

constexpr std::size_t most_curves    = 5;    ///< of a chart
constexpr double      widest_heights = 1e12; ///< of amplitudes in a chart: below are zeros and undamped antiresonances

/// Pairs that share a chart.
std::vector<std::vector<std::size_t>> chart_groups(const FrequencyResponse &response)
{
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < response.pairs.size(); ++i)
  {
    const auto joins = [&](const std::vector<std::size_t> &group)
    { return group.size() < most_curves && response.pairs[group[0]].unit == response.pairs[i].unit; };
    const auto found = std::find_if(groups.begin(), groups.end(), joins);
    if (found == groups.end())
      groups.push_back({i});
    else
      found->push_back(i);
  }
  return groups;
}

std::string frequency_tick(double f)
{
  return short_text(f, 3);
}

Chart frequency_chart(const FrequencyResponse &response)
{
  Chart chart;
  chart.width       = 880.;
  chart.x.label     = "frequency [Hz]";
  chart.x.scale     = response.logarithmic ? Scale::logarithmic : Scale::linear;
  chart.x.tick_text = frequency_tick;
  chart.x.begin     = response.frequencies_hz.front();
  chart.x.end       = response.frequencies_hz.back();
  return chart;
}

/// A curve of `of`(value), interrupted where it jumps by more than `widest`.
Curve curve_of(const std::string &name, const std::vector<double> &f, const std::vector<std::complex<double>> &values,
               double (*of)(std::complex<double>), double widest)
{
  Curve curve;
  curve.name = name;
  for (std::size_t i = 0; i < f.size(); ++i)
  {
    const double y = of(values[i]);
    if (!curve.y.empty() && std::abs(y - curve.y.back()) > widest)
      curve.add(f[i], std::nan(""));
    curve.add(f[i], y);
  }
  return curve;
}

double amplitude_of(std::complex<double> value)
{
  return std::abs(value);
}

/// Dots in the colour of the computed curve.
Curve measured_dots(const MeasuredResponse &measured, int colour, double (*of)(std::complex<double>))
{
  Curve dots;
  dots.name   = of == amplitude_of ? "measured: " + (measured.name.empty() ? measured.file : measured.name) : "";
  dots.colour = colour;
  dots.line   = LineStyle::none;
  dots.marker = Marker::disc;
  for (std::size_t i = 0; i < measured.values.size(); ++i)
    dots.add(measured.frequencies_hz[i], of(measured.values[i]));
  return dots;
}

/// Computed curves, whose colours follow each other, then measured ones.
void add_curves(const FrequencyResponse &response, const std::vector<std::size_t> &group,
                double (*of)(std::complex<double>), double widest, bool named, Chart &chart)
{
  Panel             &panel = chart.panels[0];
  std::vector<Curve> dots;
  for (const std::size_t i : group)
  {
    const ResponsePair &pair = response.pairs[i];
    panel.add(curve_of(named ? pair.name() : "", response.frequencies_hz, pair.values, of, widest));
    for (const MeasuredResponse &measured : response.measured)
      if (measured.pair == int(i) && (named || measured.has_phase))
        dots.push_back(measured_dots(measured, panel.curves.back().colour, of));
  }
  panel.curves.insert(panel.curves.end(), dots.begin(), dots.end());
}

/// Leaves out what is next to nothing.
void set_heights(Chart &chart)
{
  double high = 0., low = std::numeric_limits<double>::infinity();
  for (const Curve &curve : chart.panels[0].curves)
    for (const double y : curve.y)
      if (std::isfinite(y) && y > 0.)
        high = std::max(high, y), low = std::min(low, y);
  if (low < high / widest_heights)
    chart.y.begin = high / widest_heights;
}

Chart amplitude_chart(const FrequencyResponse &response, const std::vector<std::size_t> &group)
{
  Chart chart   = frequency_chart(response);
  chart.title   = "Amplitude";
  chart.height  = 300.;
  chart.y.label = "amplitude [" + response.pairs[group[0]].unit + "]";
  chart.y.scale = Scale::logarithmic;
  add_curves(response, group, amplitude_of, std::numeric_limits<double>::infinity(), true, chart);
  set_heights(chart);
  Curve tops = rings("", 5);
  for (const std::size_t i : group)
    for (const coupling::ResponsePeak &peak : response.pairs[i].peaks)
      if (std::isfinite(peak.amplitude))
      {
        tops.add(peak.frequency_hz, peak.amplitude);
        tops.notes.push_back({response.pairs[i].name() + ": " + short_text(peak.frequency_hz, 6) + " Hz, " +
                              short_text(peak.amplitude) + " " + response.pairs[i].unit});
      }
  chart.panels[0].curves.push_back(tops);
  return chart;
}

Chart phase_chart(const FrequencyResponse &response, const std::vector<std::size_t> &group)
{
  Chart chart   = frequency_chart(response);
  chart.title   = "Phase";
  chart.height  = 170.;
  chart.y.label = "phase [°]";
  chart.y.begin = -190.;
  chart.y.end   = 190.;
  chart.y.ticks = {-180., -90., 0., 90., 180.};
  add_curves(response, group, phase_degrees, 180., false, chart);
  return chart;
}

std::string peaks_of_pairs(const FrequencyResponse &response)
{
  HtmlTable table({"answer / force", "#f [Hz]", "#amplitude", "unit", "#damping ratio by half-power width"});
  for (const ResponsePair &pair : response.pairs)
    for (const coupling::ResponsePeak &peak : pair.peaks)
      table.add({pair.name(), short_text(peak.frequency_hz, 7),
                 std::isfinite(peak.amplitude) ? short_text(peak.amplitude, 5) : "∞", pair.unit,
                 std::isfinite(peak.damping_ratio) ? short_text(peak.damping_ratio) : "–"});
  return table.is_empty() ? "<p>No response has a peak in this band.</p>\n" : "<h3>Peaks</h3>" + table.scrolled_html();
}

std::string about(const FrequencyResponse &response)
{
  std::string text = "<p>The " + response.kind + " of the machine linearised at " +
                     (response.at == "start"         ? "the start of the scene"
                      : response.at == "equilibrium" ? "its static equilibrium"
                                                     : "its undeformed position") +
                     (response.moves ? ", in the motion of that instant" : ", at rest") + ". ";
  for (const auto &[state, names] : {std::pair("closed", &response.closed_contacts), {"open", &response.open_contacts}})
    if (!names->empty())
      text +=
          "There " + std::string(names->size() > 1 ? "are " : "is ") + state + ": " + escape_xml(listed(*names)) + ". ";
  text += "</p>\n";
  if (!response.not_condensed.empty())
    text +=
        "<p class=\"soft\">Every frequency took the whole equations: " + escape_xml(response.not_condensed) + ".</p>\n";
  return text;
}

/// Amplitude and phase of each group of pairs, with the names of their files.
std::vector<std::pair<std::string, Chart>> response_charts(const FrequencyResponse &response)
{
  std::vector<std::pair<std::string, Chart>> charts;
  int                                        number = 0;
  for (const std::vector<std::size_t> &group : chart_groups(response))
  {
    const std::string ending = ++number > 1 ? "-" + std::to_string(number) : "";
    charts.emplace_back("frf-amplitude" + ending, amplitude_chart(response, group));
    charts.emplace_back("frf-phase" + ending, phase_chart(response, group));
  }
  return charts;
}

} // namespace

Pictures frequency_response_pictures(const FrequencyResponse &response)
{
  Pictures pictures;
  for (const auto &[name, chart] : response_charts(response))
    pictures.emplace_back(name, chart_svg(chart));
  return pictures;
}

std::string frequency_response_section(const Result &result, Pictures &pictures)
{
  if (!result.frf)
    return "";
  std::string html = about(*result.frf);
  for (const auto &[name, chart] : response_charts(*result.frf))
  {
    pictures.emplace_back(name, chart_svg(chart));
    html += live_figure(chart, pictures.back().second);
  }
  html += "<p class=\"soft\">Rings: peaks.</p>\n" + peaks_of_pairs(*result.frf);
  return section("frf", "Frequency response", html);
}

} // namespace gestell::apps
