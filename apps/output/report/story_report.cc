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
  std::string html = loads.empty() ? "" : "<h3>Loads against the periods of modes</h3>";
  for (const LoadDuration &load : loads)
    html += "<p>" + escape_xml(load_text(load)) + "</p>" + (load.modes.empty() ? "" : table_of(load.modes).html());
  return loads.empty()
             ? ""
             : html + "<p class=\"soft\">Times over the period T = 1/f of a mode. The fall factor compares the "
                      "amplitude that the fall leaves with that of a sudden one; the energy is what the fall "
                      "leaves in the mode, undamped and linear.</p>\n";
}

} // namespace

std::string story_section(const Result &result)
{
  if (!result.story)
    return "";
  const RunStory &story = *result.story;
  return section(
      "story", "Events, loads and modes",
      titled("Event log", "Displacements and forces of the object of each located event.", story.events) +
          titled("Extremes of forces and modes",
                 "Share of the mode that makes most of the force's change between the turning points of "
                 "the swing about an extreme, and the sum over all modes. A mode carries a swing of which it "
                 "makes most and whose frequency it has.",
                 story.extremes) +
          loads_html(story.loads) +
          titled("Cycles through a play",
                 "Between two events of one kind in which the deflection crosses the whole play: frequency "
                 "in the run, and that of the closed machine with the stiffness of the first harmonic.",
                 story.plays),
      Shown::folded);
}

} // namespace gestell::apps
