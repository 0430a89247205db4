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

Json load_json(const LoadDuration &load)
{
  Json json = {{"signal", load.signal},
               {"element", load.element},
               {"begin", load.begin},
               {"end", load.end},
               {"peak", load.peak},
               {"t_peak", load.t_peak},
               {"rise", load.rise},
               {"t_fall", load.t_fall},
               {"fall", load.fall},
               {"row_step", load.row_step},
               {"is_coarse", load.is_coarse()},
               {"t_modes", load.unknown.empty() ? Json(load.t_modes) : Json()},
               {"place", load.place},
               {"no_modes_because", load.unknown},
               {"modes", Json::array()}};
  for (const LoadOnMode &on : load.modes)
    json["modes"].push_back({{"mode", on.mode < 0 ? Json() : Json(on.mode + 1)},
                             {"frequency_hz", on.frequency_hz},
                             {"duration_over_period", on.duration},
                             {"rise_over_period", on.rise},
                             {"fall_over_period", on.fall},
                             {"fall_factor", on.fall_factor},
                             {"energy", std::isfinite(on.energy) ? Json(on.energy) : Json()}});
  return json;
}

Json play_json(const PlayEstimate &play)
{
  return {{"element", play.element}, {"signal", play.signal},
          {"unit", play.unit},       {"begin", play.begin},
          {"end", play.end},         {"amplitude", play.amplitude},
          {"mean", play.mean},       {"stiffness_share", play.stiffness_share},
          {"mode", play.mode + 1},   {"frequency_hz", play.frequency_hz},
          {"seen_hz", play.seen_hz}, {"closed_hz", play.closed_hz},
          {"limits", play.limits}};
}

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

Json story_json(const RunStory &story)
{
  Json json = {{"loads", Json::array()}, {"sentences", Json::array()}, {"plays", Json::array()}};
  for (const LoadDuration &load : story.loads)
    json["loads"].push_back(load_json(load));
  for (const StorySentence &sentence : story.sentences)
    json["sentences"].push_back({{"t", sentence.t}, {"text", sentence.text}});
  for (const PlayEstimate &play : story.plays)
    json["plays"].push_back(play_json(play));
  return json;
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
