#include "apps/analysis/sensitivities/sensitivity_section.h"

#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr std::size_t most_charts = 8, most_bars = 10, most_named = 5;
constexpr double      bar_half  = 0.3;  ///< height, of the place a bar has
constexpr double      no_change = 1e-9; ///< [%] that is rounding

/// Keys of an output with a derivative, the one with the largest change by 1 % first.
std::vector<Eigen::Index> by_influence(const SensitivityResult &result, const SensitivityOutput &output)
{
  std::vector<Eigen::Index> order;
  const auto change = [&](Eigen::Index k) { return std::abs(output.percent(result.keys[std::size_t(k)], k)); };
  for (Eigen::Index k = 0; k < Eigen::Index(result.keys.size()); ++k)
    if (const double size = change(k); std::isfinite(size) && size > no_change)
      order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return change(a) > change(b); });
  return order;
}

std::string number_or_blank(double x)
{
  return std::isfinite(x) ? exact_text(x) : "";
}

std::string signed_percent(double change)
{
  return (change > 0. ? "+" : "") + short_text(change, 3) + " %";
}

/// The last part of a key: "c_P" of "parameters.c_P".
std::string short_key(const std::string &key)
{
  const std::string table = "parameters.";
  return key.compare(0, table.size(), table) == 0 ? key.substr(table.size()) : key;
}

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Chart tornado(const SensitivityResult &found, const SensitivityOutput &output, const std::vector<Eigen::Index> &keys)
{
  const std::size_t n = std::min(keys.size(), most_bars);
  Chart             chart;
  chart.title       = "Change of " + output.output + " for a 1 % increase";
  chart.note        = output.output + " = " + short_text(output.value, 5) + " " + output.unit;
  chart.width       = 460.;
  chart.height      = 70. + 18. * double(n);
  const double most = std::abs(output.percent(found.keys[std::size_t(keys.front())], keys.front()));
  chart.x.label     = "change [%]";
  chart.x.begin     = -1.15 * most;
  chart.x.end       = 1.9 * most; // space for names on the right
  chart.y.begin     = 0.;
  chart.y.end       = double(n) + 0.4;
  chart.y.ticks     = {0.};
  chart.y.tick_text = [](double) { return std::string(); };
  for (std::size_t i = 0; i < n; ++i)
  {
    const SensitivityKey &key    = found.keys[std::size_t(keys[i])];
    const double          change = output.percent(key, keys[i]), y = double(n - i) - 0.4;
    const std::string     name = short_key(key.key) + " " + signed_percent(change);
    chart.panels[0].tiles.push_back(
        {std::min(0., change), std::max(0., change), y - bar_half, y + bar_half, change > 0. ? 0 : 1, name});
    chart.levels.push_back({y, name});
  }
  return chart;
}

std::string named_changes(const SensitivityResult &found, const SensitivityOutput &output)
{
  const auto  keys = by_influence(found, output);
  std::string text;
  for (std::size_t i = 0; i < std::min(keys.size(), most_named); ++i)
  {
    const SensitivityKey &key = found.keys[std::size_t(keys[i])];
    text += (i > 0 ? ", " : "") + short_key(key.key) + ' ' + signed_percent(output.percent(key, keys[i]));
  }
  return text;
}

} // namespace

std::string sensitivities_csv(const SensitivityResult &result)
{
  std::string csv = "output,key,derivative,unit,change by 1 %,note\n";
  for (const SensitivityOutput &output : result.outputs)
    for (Eigen::Index k = 0; k < output.derivative.size(); ++k)
    {
      const SensitivityKey &key  = result.keys[std::size_t(k)];
      const std::string    &note = std::isfinite(output.derivative[k]) ? key.frame : output.note;
      csv += csv_field(output.output) + ',' + csv_field(key.key) + ',' + number_or_blank(output.derivative[k]) + ',' +
             csv_field(derivative_unit(output, key)) + ',' + number_or_blank(output.percent(key, k)) + ',' +
             csv_field(note) + '\n';
    }
  return result.failure.empty() ? csv : "";
}

std::vector<Section> sections_of(const Result &, const SensitivityResult &found)
{
  using Part = Section::Sentences;
  Section section{"sensitivities", "Sensitivities", "Sensitivities"};
  if (!found.failure.empty())
    section.parts.push_back(Part{"No sensitivities: " + found.failure, true});
  std::vector<Section::Part> charts;
  const std::string          change = "change for a 1 % increase of a parameter (+: larger magnitude)";
  HtmlTable                  peaks({"output", "#value", "unit", change}), others({"output", "#value", "unit", change});
  for (const SensitivityOutput &output : found.outputs)
  {
    const auto keys = by_influence(found, output);
    if (keys.empty())
      continue;
    const bool        peak = ends_with(output.output, ".max") || ends_with(output.output, ".min");
    const std::string note = output.note.empty() ? "" : " (" + output.note + ")";
    (peak ? peaks : others)
        .add({output.output + note, short_text(output.value, 6), output.unit, named_changes(found, output)});
    if (peak && charts.size() < most_charts)
      charts.push_back(Section::Drawing{"sensitivity-" + std::to_string(charts.size() + 1),
                                        tornado(found, output, keys), ChartLink::none,
                                        Section::Drawing::Shown::picture});
  }
  if (!charts.empty())
    section.parts.push_back(
        Part{"Derivatives of the results of this run. They are valid as long as the order of events does not change.",
             true});
  section.parts.insert(section.parts.end(), charts.begin(), charts.end());
  if (peaks.is_empty() && others.is_empty() && found.failure.empty() && !found.interrupted)
    section.parts.push_back(Part{"None of these parameters changes an output of this run."});
  section.parts.push_back(peaks);
  section.parts.push_back(Section::PageTable{others});
  for (const SensitivityKey &key : found.keys)
    if (!key.frame.empty())
      section.parts.push_back(
          Part{short_key(key.key) + " changes the reduced frame; this contribution is computed by " + key.frame + ".",
               true});
  return {section};
}

} // namespace gestell::apps
