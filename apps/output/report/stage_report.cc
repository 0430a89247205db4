#include "apps/output/report/stage_report.h"

#include "apps/output/describe/described_table.h"
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

/// Each mode beside the linearised one.
std::string ringing_html(const Ringing &ringing)
{
  if (ringing.modes.empty())
    return "";
  return "<p>What rings from " + seconds_text(ringing.begin) + " to " + seconds_text(ringing.end) +
         " s, behind the last contact: damped frequencies and damping found in the signals by the matrix pencil, which "
         "leaves " +
         short_text(100. * ringing.residual, 2) +
         " % of them, beside those of the machine linearised at rest. Large swings are slower than small ones, and "
         "make others: multiples and sums of their frequencies.</p>\n" +
         table_of(ringing.modes).html();
}

} // namespace

std::string stage_section(const Result &result)
{
  if (!result.stages)
    return "";
  std::string html = stages_html(result.stages->stages) +
                     (result.stages->lift_offs.empty() ? "" : table_of(result.stages->lift_offs).html()) +
                     ringing_html(result.stages->ringing);
  if (const std::string &note = result.stages->ringing.note; !note.empty())
    html += "<p>" + escape_xml(note) + "</p>\n";
  return section("stages", result.stages->stages.empty() ? "Off the ground" : "Stages of the run", html);
}

} // namespace gestell::apps
