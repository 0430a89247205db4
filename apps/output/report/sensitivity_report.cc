#include "apps/output/report/sensitivity_report.h"

#include "apps/output/charts/chart.h"
#include "apps/output/tables/sensitivity_table.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

std::string signed_percent(double change)
{
  return (change > 0. ? "+" : "") + short_text(change, 3) + " %";
}

/// The part of a key that a reader looks for: "c_P" of "parameters.c_P".
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
  constexpr std::size_t most_bars = 10; // keys of a chart; the table has all
  const std::size_t     n         = std::min(keys.size(), most_bars);
  Chart                 chart;
  chart.title       = "1 % more changes " + output.output;
  chart.note        = output.output + " = " + short_text(output.value, 5) + " " + output.unit;
  chart.width       = 460.;
  chart.height      = 70. + 18. * double(n);
  const double most = std::abs(output.percent(found.keys[std::size_t(keys.front())], keys.front()));
  chart.x.label     = "change [%]";
  chart.x.begin     = -1.15 * most;
  chart.x.end       = 1.9 * most; // names stand at the right
  chart.y.begin     = 0.;
  chart.y.end       = double(n) + 0.4;
  chart.y.ticks     = {0.};
  chart.y.tick_text = [](double) { return std::string(); };
  for (std::size_t i = 0; i < n; ++i)
  {
    const SensitivityKey &key    = found.keys[std::size_t(keys[i])];
    const double          change = output.percent(key, keys[i]), y = double(n - i) - 0.4;
    const std::string     name     = short_key(key.key) + " " + signed_percent(change);
    constexpr double      bar_half = 0.3; // height, of the place a bar has
    chart.panels[0].tiles.push_back(
        {std::min(0., change), std::max(0., change), y - bar_half, y + bar_half, change > 0. ? 0 : 1, name});
    chart.levels.push_back({y, name});
  }
  return chart;
}

std::string named_changes(const SensitivityResult &found, const SensitivityOutput &output)
{
  const auto            keys = by_influence(found, output);
  std::string           text;
  constexpr std::size_t most_named = 5; // keys of a line of text
  for (std::size_t i = 0; i < std::min(keys.size(), most_named); ++i)
  {
    const SensitivityKey &key = found.keys[std::size_t(keys[i])];
    text += (i > 0 ? ", " : "") + short_key(key.key) + ' ' + signed_percent(output.percent(key, keys[i]));
  }
  return text;
}

std::string leading_sentence(const SensitivityResult &found, const SensitivityOutput &output)
{
  const Eigen::Index k = by_influence(found, output).front();
  return "<p>1 % more " + short_key(found.keys[std::size_t(k)].key) + " changes " + output.output + " by " +
         signed_percent(output.percent(found.keys[std::size_t(k)], k)) +
         ". Derivatives are those of the equations of motion at this run; where an event changes place with another, "
         "they end.</p>\n";
}

/// How the frame's share of derivatives was found.
std::string frame_sentences(const SensitivityResult &found)
{
  std::string html;
  for (const SensitivityKey &key : found.keys)
    if (!key.frame.empty())
      html += "<p>" + escape_xml(short_key(key.key)) + " changes the reduced frame, whose share is found by " +
              escape_xml(key.frame) + ".</p>\n";
  return html;
}

} // namespace

std::string sensitivity_section(const Result &result, Pictures &pictures)
{
  if (!result.sensitivities)
    return "";
  if (!result.sensitivities->failure.empty())
    return section("sensitivities", "Sensitivities", note_box({result.sensitivities->failure}, "There are none"));
  const SensitivityResult &found = *result.sensitivities;
  std::string              html;
  std::size_t              n_charts = 0;
  HtmlTable                table({"output", "#value", "unit", "1 % more of ... changes it by"});
  for (const SensitivityOutput &output : found.outputs)
  {
    const auto keys = by_influence(found, output);
    if (keys.empty())
      continue;
    const std::string note = output.note.empty() ? "" : " (" + output.note + ")";
    table.add({output.output + note, short_text(output.value, 6), output.unit, named_changes(found, output)});
    const bool            peak        = ends_with(output.output, ".max") || ends_with(output.output, ".min");
    constexpr std::size_t most_charts = 8; // outputs; the table has all
    if (!peak || n_charts >= most_charts)
      continue;
    if (n_charts == 0)
      html += leading_sentence(found, output);
    pictures.emplace_back("sensitivity-" + std::to_string(++n_charts), chart_svg(tornado(found, output, keys)));
    html += figure(pictures.back().second);
  }
  if (table.is_empty())
    html += "<p>None of these entries changes an output of this run.</p>\n";
  else
    html += table.scrolled_html();
  return section("sensitivities", "Sensitivities", html + frame_sentences(found));
}

} // namespace gestell::apps
