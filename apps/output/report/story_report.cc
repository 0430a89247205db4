#include "apps/output/report/story_report.h"

#include "apps/output/tables/story_table.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

std::string milliseconds(double t)
{
  return short_text(1e3 * t, 4) + " ms";
}

std::string load_html(const LoadDuration &load)
{
  const DisplayUnit unit = display_unit(load.unit, std::abs(load.peak));
  HtmlTable table({"#mode", "#f [Hz]", "#T [ms]", "#duration/T", "#rise/T", "#fall/T", "#left of a step", "#energy [J]",
                   "", "strain energy in"});
  for (const LoadOnMode &on : load.modes)
    table.add({mode_number(on), short_text(on.frequency_hz, 4), short_text(1e3 / on.frequency_hz, 4),
               short_text(on.duration, 3), short_text(on.rise, 3), peak(short_text(on.fall, 3), on.fall < 0.25),
               short_text(on.fall_factor, 3), energy_text(on.energy, load), excitation_words(on), on.strain});
  return "<p><strong>" + escape_xml(load.signal) + "</strong> (" + escape_xml(load.element) + ") acts from " +
         short_text(load.begin, 6) + " s on, where it comes above 1 % of its peak, and begins to fall, below 90 %, " +
         milliseconds(load.t_fall - load.begin) +
         " later: that is the duration beside the periods. Above 1 % it stays for " +
         milliseconds(load.end - load.begin) + ". It rises within " + milliseconds(load.rise) + ", is largest with " +
         short_text(unit.factor * load.peak, 5) + " " + unit.unit + " at " + short_text(load.t_peak, 6) +
         " s and falls within " + milliseconds(load.fall) + "." +
         (load.is_coarse() ? " " + coarse_rows_words(load) + "." : "") +
         " A fall within a quarter of a period acts on that mode like a step. The energy is what the fall leaves in "
         "the mode, undamped and linear, of the machine as it stands where the fall begins (" +
         escape_xml(modes_place_words(load)) +
         "); a mode is numbered where its shape there is that of a mode in the table of modes.</p>\n" +
         (table.is_empty() ? "" : table.html());
}

std::string plays_html(const std::vector<PlayEstimate> &plays)
{
  if (plays.empty())
    return "";
  HtmlTable table({"element", "#from t [s]", "#to t [s]", "#amplitude", "#mean", "unit", "#equivalent stiffness",
                   "#f estimated [Hz]", "#f seen [Hz]", "#f closed [Hz]", "limits"});
  double    largest = 0.;
  for (const PlayEstimate &play : plays)
    largest = std::max({largest, play.amplitude, std::abs(play.mean)});
  for (const PlayEstimate &play : plays)
  {
    const DisplayUnit unit = display_unit(play.unit, largest);
    table.add({play.element, short_text(play.begin, 5), short_text(play.end, 5),
               short_text(unit.factor * play.amplitude, 3), short_text(unit.factor * play.mean, 3), unit.unit,
               gestell::percent(play.stiffness_share, 3), short_text(play.frequency_hz, 4), short_text(play.seen_hz, 4),
               short_text(play.closed_hz, 4), play.limits});
  }
  return "<h3>Play by its describing function</h3><p>Cycles between two events of one kind in which the deflection "
         "crosses "
         "the whole play: frequency seen, and that of the closed machine with the stiffness of the first harmonic at "
         "the amplitude of the cycle.</p>\n" +
         table.html();
}

} // namespace

std::string story_section(const Result &result)
{
  if (!result.story)
    return "";
  HtmlTable table({"#t [s]", "what happens"});
  for (const StorySentence &sentence : result.story->sentences)
    table.add({short_text(sentence.t, 6), peak(sentence.text, sentence.stands_out)});
  std::string html = table.is_empty() ? "" : table.scrolled_html();
  if (!result.story->loads.empty())
    html += "<h3>Loads against the periods</h3>";
  for (const LoadDuration &load : result.story->loads)
    html += load_html(load);
  return section("story", "The run told by its events", html + plays_html(result.story->plays));
}

} // namespace gestell::apps
