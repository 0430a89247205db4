#pragma once

#include "apps/output/values/result.h"

namespace gestell::apps
{

/// The signal whose extreme a picture of the run shows: the first force, else the first that is asked for; -1: none.
int main_signal(const std::vector<coupling::Signal> &signals);

/// Asks a run to keep, behind all other extremes, the states at the largest and the smallest value of that signal.
void ask_for_peak(const std::vector<coupling::Signal> &signals, coupling::StateRequest &states);

/// Takes from the run the one of the larger magnitude; nothing where the run did not come to one.
std::optional<PeakState> taken_peak(const std::vector<coupling::Signal> &signals, coupling::RunResult &run);

} // namespace gestell::apps
