#pragma once

#include "apps/output/values/run_story.h"

#include <string>

namespace gestell::apps
{

/// What a load does to a mode, in words: "acts like a step", "excites it by 60 %", "hardly excites it".
std::string excitation_words(const LoadOnMode &on);

/// That times of a load are read from rows too far apart, and the way out.
std::string coarse_rows_words(const LoadDuration &load);

/// "modes at 0.2391 s, crank 160.2 deg", where it falls; or why there are none.
std::string modes_place_words(const LoadDuration &load);

/// The number of a mode among those of the scene; "-": its shape is that of none.
std::string mode_number(const LoadOnMode &on);

/// Energy left in a mode, as text [J]: 0 where it is rounding beside the largest of the load, "-" where not known.
std::string energy_text(double energy, const LoadDuration &load);

/// For a terminal: the loads against the periods, and the plays.
std::string story_text(const RunStory &story);

} // namespace gestell::apps
