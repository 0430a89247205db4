#include "apps/output/report/story_report.h"

#include "apps/output/describe/described_table.h"
#include "apps/output/tables/story_table.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"

namespace gestell::apps
{

namespace
{

template <class T>
std::string titled(const std::string &title, const std::string &caption, const std::vector<T> &items)
{
  return items.empty() ? ""
                       : "<h3>" + title + "</h3>" + table_of(items).html() + "<p class=\"soft\">" + caption + "</p>\n";
}

std::string loads_html(const std::vector<LoadDuration> &loads)
{
  std::string html = loads.empty() ? "" : "<h3>Load durations relative to mode periods</h3>";
  for (const LoadDuration &load : loads)
    html += "<p>" + escape_xml(load_text(load)) + "</p>" + (load.modes.empty() ? "" : table_of(load.modes).html());
  return loads.empty()
             ? ""
             : html + "<p class=\"soft\">Times are relative to the period T = 1/f of a mode. The residual vibration "
                      "ratio is the amplitude after the load is removed, relative to that after a sudden removal. "
                      "The energy is that of the linear, undamped mode after the removal.</p>\n";
}

} // namespace

std::string story_section(const Result &result)
{
  if (!result.story)
    return "";
  const RunStory &story = *result.story;
  return section("story", "Events, loads and modes",
                 titled("Event log", "Displacement and force of the object at each located event.", story.events) +
                     titled("Force extremes and their dominant modes",
                            "The share is the contribution of the dominant mode to the change of the force between the "
                            "turning points around an extreme. The sum is over all modes. A mode explains the "
                            "oscillation if its share is near 1 and its frequency agrees with the observed one.",
                            story.extremes) +
                     loads_html(story.loads) +
                     titled("Oscillations through a clearance",
                            "Oscillation between two events of the same kind in which the deflection crosses the whole "
                            "clearance. The observed frequency is compared with that of the describing function "
                            "(first-harmonic stiffness).",
                            story.plays),
                 Shown::folded);
}

} // namespace gestell::apps
