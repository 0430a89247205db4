#include "apps/output/tables/story_table.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::apps
{

namespace
{

void add_load(const LoadDuration &load, std::ostream &text)
{
  text << load.signal << " acts from " << short_text(load.begin, 6) << " to " << short_text(load.end, 6)
       << " s (above 1 % of its peak), " << short_text(1e3 * (load.t_fall - load.begin), 4)
       << " ms until it begins to fall (below 90 %), and falls within " << short_text(1e3 * load.fall, 4) << " ms\n"
       << (load.is_coarse() ? "  " + coarse_rows_words(load) + "\n" : "") << "  " << modes_place_words(load) << '\n';
  if (!load.modes.empty())
    text << "  mode   f [Hz]   duration/T   rise/T   fall/T   left of a step   energy [J]\n";
  for (const LoadOnMode &on : load.modes)
    text << std::setw(6) << mode_number(on) << std::setw(9) << short_text(on.frequency_hz, 4) << std::setw(13)
         << short_text(on.duration, 3) << std::setw(9) << short_text(on.rise, 3) << std::setw(9)
         << short_text(on.fall, 3) << std::setw(17) << short_text(on.fall_factor, 3) << std::setw(13)
         << energy_text(on.energy, load) << "   " << excitation_words(on) << '\n';
}

} // namespace

std::string energy_text(double energy, const LoadDuration &load)
{
  if (!std::isfinite(energy))
    return "-";
  double largest = 0.;
  for (const LoadOnMode &on : load.modes)
    largest = std::max(largest, on.energy);
  return energy < 1e-6 * largest ? "0" : short_text(energy, 3);
}

std::string mode_number(const LoadOnMode &on)
{
  return on.mode < 0 ? "-" : std::to_string(on.mode + 1);
}

std::string modes_place_words(const LoadDuration &load)
{
  if (!load.unknown.empty())
    return "which modes it excites is not known: " + load.unknown;
  const std::string where =
      "modes at " + short_text(load.t_modes, 6) + " s" + (load.place.empty() ? "" : ", " + load.place);
  return load.modes.empty() ? where + ": none with a period that the load could excite" : where;
}

std::string coarse_rows_words(const LoadDuration &load)
{
  return "these times are coarse, as rows of the history are " + short_text(1e3 * load.row_step, 3) +
         " ms apart: give output.step a smaller value";
}

std::string excitation_words(const LoadOnMode &on)
{
  if (on.fall < 0.25)
    return "the fall acts like a step";
  if (on.fall < 1.)
    return "the fall excites it by " + gestell::percent(on.fall_factor, 2) + " of a step";
  return "the fall hardly excites it";
}

std::string story_text(const RunStory &story)
{
  std::ostringstream text;
  for (const LoadDuration &load : story.loads)
    add_load(load, text);
  for (const PlayEstimate &play : story.plays)
    text << play.element << " with play swings with " << short_text(play.seen_hz, 4) << " Hz from "
         << short_text(play.begin, 5) << " to " << short_text(play.end, 5) << " s; by its describing function "
         << short_text(play.frequency_hz, 4) << " Hz, closed " << short_text(play.closed_hz, 4) << " Hz"
         << (play.limits.empty() ? "" : "; " + play.limits) << '\n';
  return text.str();
}

} // namespace gestell::apps
