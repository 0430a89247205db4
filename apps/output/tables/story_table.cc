#include "apps/output/tables/story_table.h"

#include "apps/output/describe/described_table.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{

namespace
{

std::string modes_text(const LoadDuration &load)
{
  if (!load.unknown.empty())
    return "no modes: " + load.unknown;
  const std::string where =
      "modes at " + short_text(load.t_modes, 6) + " s" + (load.place.empty() ? "" : ", " + load.place);
  return load.modes.empty() ? where + ": no mode has a period that the load could excite" : where;
}

std::string milliseconds(double t)
{
  return short_text(1e3 * t, 4) + " ms";
}

} // namespace

std::string load_text(const LoadDuration &load)
{
  return load.signal + ": above 1 % of its peak from " + short_text(load.begin, 6) + " to " + short_text(load.end, 6) +
         " s; rise time " + milliseconds(load.rise) + ", below 90 % after " + milliseconds(load.t_fall - load.begin) +
         ", fall time " + milliseconds(load.fall) + "; " + modes_text(load) +
         (load.is_coarse() ? "; rows of the history are " + milliseconds(load.row_step) +
                                 " apart, which is too coarse for these times: reduce output.step"
                           : "");
}

std::string story_text(const RunStory &story)
{
  std::string text;
  for (const LoadDuration &load : story.loads)
    text += load_text(load) + '\n' + (load.modes.empty() ? "" : table_of(load.modes).terminal());
  return text + (story.plays.empty() ? "" : "oscillations through a clearance\n" + table_of(story.plays).terminal());
}

} // namespace gestell::apps
