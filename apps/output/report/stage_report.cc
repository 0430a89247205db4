#include "apps/output/report/stage_report.h"

#include "apps/output/tables/noise.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

std::string seconds_text(double t)
{
  return short_text(t, 5);
}

/// Extremes of every signal, a pair of columns for each stage.
std::string stages_html(const std::vector<Stage> &stages)
{
  if (stages.empty())
    return "";
  std::vector<std::string> heads{"signal", "unit"};
  for (const Stage &stage : stages)
    for (const char *extreme : {" least", " most"})
      heads.push_back("#" + stage.name + extreme);
  HtmlTable table(heads);
  Noise     noise;
  for (const Stage &stage : stages)
    for (const auto &extremes : stage.extremes)
      noise.see(extremes.unit, std::max(std::abs(extremes.min), std::abs(extremes.max)));
  for (std::size_t i = 0; i < stages.front().extremes.size(); ++i)
  {
    double size = 0.;
    for (const Stage &stage : stages)
      size = std::max({size, std::abs(stage.extremes[i].min), std::abs(stage.extremes[i].max)});
    const DisplayUnit            unit = display_unit(stages.front().extremes[i].unit, size);
    std::vector<HtmlTable::Cell> row{stages.front().extremes[i].signal, unit.unit};
    for (const Stage &stage : stages)
      for (const double x : {stage.extremes[i].min, stage.extremes[i].max})
        row.push_back(short_text(unit.factor * noise.without(stages.front().extremes[i].unit, x), 5));
    table.add(row);
  }
  std::string text = "<p>";
  for (const Stage &stage : stages)
    text += "<strong>" + escape_xml(stage.name) + "</strong> from " + seconds_text(stage.begin) + " to " +
            seconds_text(stage.end) + " s" + (&stage == &stages.back() ? ".</p>\n" : ", ");
  return text + table.scrolled_html();
}

std::string lift_off_html(const std::vector<LiftOff> &lift_offs)
{
  if (lift_offs.empty())
    return "";
  HtmlTable table({"off the ground", "#from t [s]", "#to t [s]", "#for [s]"});
  for (const LiftOff &off : lift_offs)
    table.add({off.wheel, short_text(off.begin, 6), short_text(off.end, 6), short_text(off.end - off.begin, 3)});
  return table.html();
}

std::string percent_off(double found, double expected)
{
  return short_text(100. * (found / expected - 1.), 2) + " %";
}

/// Each mode beside the linearised one.
std::string ringing_html(const Ringing &ringing)
{
  if (ringing.modes.empty())
    return "";
  std::vector<std::string> heads{"#frequency [Hz]", "#linearised [Hz]", "#off by",
                                 "#damping ratio",  "#linearised",      "#mode"};
  for (std::size_t s = 0; s < ringing.signals.size(); ++s)
    heads.push_back("#amplitude of " + ringing.signals[s] + " [" + ringing.units[s] + "]");
  HtmlTable table(heads);
  for (const RingingMode &mode : ringing.modes)
  {
    const bool                   paired = mode.linearised >= 0;
    std::vector<HtmlTable::Cell> row{short_text(mode.frequency_hz, 5),
                                     paired ? short_text(mode.linearised_hz, 5) : "",
                                     paired ? percent_off(mode.frequency_hz, mode.linearised_hz) : mode.combination,
                                     short_text(mode.damping_ratio, 3),
                                     paired ? short_text(mode.linearised_ratio, 3) : "",
                                     paired ? std::to_string(mode.linearised + 1) : ""};
    for (const double amplitude : mode.amplitudes)
      row.push_back(short_text(amplitude, 3));
    table.add(row);
  }
  return "<p>What rings from " + seconds_text(ringing.begin) + " to " + seconds_text(ringing.end) +
         " s, behind the last contact: damped frequencies and damping found in the signals by the matrix pencil, which "
         "leaves " +
         short_text(100. * ringing.residual, 2) +
         " % of them, beside those of the machine linearised at rest. Large swings are slower than small ones, and "
         "make others: multiples and sums of their frequencies.</p>\n" +
         table.scrolled_html();
}

} // namespace

std::string stage_section(const Result &result)
{
  if (!result.stages)
    return "";
  std::string html = stages_html(result.stages->stages) + lift_off_html(result.stages->lift_offs) +
                     ringing_html(result.stages->ringing);
  if (!result.stages->reason.empty())
    html += "<p>" + escape_xml(result.stages->reason) + "</p>\n";
  return section("stages", result.stages->stages.empty() ? "Off the ground" : "Stages of the run", html);
}

} // namespace gestell::apps
