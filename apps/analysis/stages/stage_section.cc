#include "apps/analysis/stages/stage_result.h"
#include "apps/output/describe/described_table.h"
#include "apps/output/tables/noise.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

std::string interval_text(double begin, double end)
{
  return "from " + short_text(begin, 6) + " to " + short_text(end, 6) + " s";
}

/// Extremes of every signal, a pair of columns for each stage.
HtmlTable stage_table(const std::vector<Stage> &stages)
{
  std::vector<std::string> heads{"signal", "unit"};
  for (const Stage &stage : stages)
    for (const char *extreme : {" minimum", " maximum"})
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
  return table;
}

/// Each mode with the linearised one.
void add_ringing(const Ringing &ringing, std::vector<Section::Part> &parts)
{
  if (!ringing.modes.empty())
  {
    parts.push_back(Section::Sentences{"Ringing " + interval_text(ringing.begin, ringing.end) +
                                       ", after the last contact, compared with the machine linearised at rest."});
    parts.push_back(Section::Sentences{
        "Damped frequencies and damping ratios are identified by the matrix-pencil method, with a fit residual of " +
            short_text(100. * ringing.residual, 2) +
            " %. Large oscillations are slower than small ones and generate multiples and sums of their frequencies.",
        true});
    parts.push_back(table_of(ringing.modes).shown());
  }
  if (!ringing.note.empty())
    parts.push_back(
        Section::Sentences{ringing.note, ringing.signals.empty()}); // without signals it is the failure of the run
}

} // namespace

std::vector<Section> sections_of(const Result &, const StageResult &found)
{
  Section section{"stages", found.stages.empty() ? "Wheel lift-off" : "Stages of the run", "", Section::Place::course};
  for (const Stage &stage : found.stages)
    section.parts.push_back(Section::Sentences{stage.name + " " + interval_text(stage.begin, stage.end)});
  if (!found.stages.empty())
    section.parts.push_back(Section::PageTable{stage_table(found.stages)});
  if (!found.lift_offs.empty() && !found.stages.empty())
    section.parts.push_back(Section::Sentences{"Wheel lift-off:"});
  if (!found.lift_offs.empty())
    section.parts.push_back(table_of(found.lift_offs).shown());
  add_ringing(found.ringing, section.parts);
  return {section};
}

} // namespace gestell::apps
