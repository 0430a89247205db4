#include "apps/analysis/frf/frequency_response.h"
#include "apps/output/report/section.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

namespace
{

/// Pairs that share a chart.
std::vector<std::vector<std::size_t>> chart_groups(const FrequencyResponse &response)
{
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < response.pairs.size(); ++i)
  {
    constexpr std::size_t most_curves = 5; // in a chart: more curves cannot be distinguished
    const auto            joins       = [&](const std::vector<std::size_t> &group)
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

double phase_degrees(std::complex<double> value)
{
  return std::arg(value) * 180. / M_PI;
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
  constexpr double widest_heights = 1e12; // of amplitudes in a chart: below are zeros and undamped antiresonances
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

HtmlTable peaks_of_pairs(const FrequencyResponse &response)
{
  HtmlTable table({"response / force", "#peak frequency [Hz]", "#amplitude", "#damping ratio (half-power bandwidth)"});
  for (const ResponsePair &pair : response.pairs)
  {
    const std::string name = pair.name() + " [" + pair.unit + "]";
    if (pair.peaks.empty())
      table.add({name, "no peak in this band", "", ""});
    for (const coupling::ResponsePeak &peak : pair.peaks)
      table.add({name, short_text(peak.frequency_hz, 7),
                 std::isfinite(peak.amplitude) ? short_text(peak.amplitude, 5) : "infinite",
                 std::isfinite(peak.damping_ratio) ? short_text(peak.damping_ratio) : "–"});
  }
  return table;
}

std::string operating_point_text(const FrequencyResponse &response)
{
  std::string text = "The " + response.kind + " of the machine linearised " +
                     (response.at == "start"         ? "in the initial state"
                      : response.at == "equilibrium" ? "in static equilibrium"
                                                     : "in the undeformed configuration") +
                     (response.moves ? ", in motion" : ", at rest");
  for (const auto &[state, names] : {std::pair("closed", &response.closed_contacts), {"open", &response.open_contacts}})
    if (!names->empty())
      text += std::string("; ") + state + " contacts: " + listed(*names);
  return text;
}

} // namespace

std::vector<Section> sections_of(const Result &, const FrequencyResponse &response)
{
  Section section{"frf", "Frequency response", "Frequency response", Section::Place::first};
  section.parts.push_back(Section::Sentences{operating_point_text(response)});
  section.parts.push_back(peaks_of_pairs(response));
  if (!response.not_condensed.empty())
    section.parts.push_back(Section::Sentences{
        "All frequencies were solved with the full equations: " + response.not_condensed + ".", true, true});
  int number = 0;
  for (const std::vector<std::size_t> &group : chart_groups(response))
  {
    const std::string ending = ++number > 1 ? "-" + std::to_string(number) : "";
    section.parts.push_back(Section::Drawing{"frf-amplitude" + ending, amplitude_chart(response, group)});
    section.parts.push_back(Section::Drawing{"frf-phase" + ending, phase_chart(response, group)});
  }
  section.parts.push_back(Section::Sentences{"Rings mark peaks.", true, true});
  return {section};
}

Headline headline_of(const FrequencyResponse &response)
{
  Headline headline{"The " + response.kind + " from " + short_text(response.frequencies_hz.front()) + " to " +
                    short_text(response.frequencies_hz.back()) + " Hz: peaks of " +
                    count_text(response.pairs.size(), "pair") + " of force and response."};
  constexpr std::size_t most_pairs = 4; // a row; the table has all
  for (const ResponsePair &pair : response.pairs)
  {
    const auto lower = [](const coupling::ResponsePeak &a, const coupling::ResponsePeak &b)
    { return a.amplitude < b.amplitude; };
    const auto highest = std::max_element(pair.peaks.begin(), pair.peaks.end(), lower);
    if (headline.numbers.size() == most_pairs)
      break;
    if (highest == pair.peaks.end())
      headline.numbers.push_back({"no peak", pair.name()});
    else
      headline.numbers.push_back({(std::isfinite(highest->amplitude) ? short_text(highest->amplitude) : "infinite") +
                                      " " + pair.unit + " at " + short_text(highest->frequency_hz) + " Hz",
                                  pair.name() + ", highest of " + count_text(pair.peaks.size(), "peak")});
  }
  return headline;
}

CsvTable frequency_response_csv(const FrequencyResponse &response)
{
  std::vector<std::string> heads{"frequency [Hz]"};
  for (const ResponsePair &pair : response.pairs)
  {
    for (const char *part : {" re [", " im [", " abs ["})
      heads.push_back(pair.name() + part + pair.unit + ']');
    heads.push_back(pair.name() + " phase [deg]");
  }
  CsvTable csv(heads);
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
  {
    std::vector<double> row{response.frequencies_hz[i]};
    for (const ResponsePair &pair : response.pairs)
    {
      const std::complex<double> z = pair.values[i];
      row.insert(row.end(), {z.real(), z.imag(), std::abs(z), phase_degrees(z)});
    }
    csv.add(row);
  }
  return csv;
}

} // namespace gestell::apps
