#pragma once

#include "apps/output/values/result.h"

namespace gestell::apps
{

/// Index of the signal whose extreme a picture shows: the first force, else the first requested one; -1: none.
int main_signal(const std::vector<coupling::Signal> &signals);

/// Adds to the requested states, after all other extremes, those at the largest and the smallest value of that signal.
void ask_for_peak(const std::vector<coupling::Signal> &signals, coupling::StateRequest &states);

/// Takes from the run the state with the larger magnitude; empty if the run reached neither.
std::optional<PeakState> taken_peak(const std::vector<coupling::Signal> &signals, coupling::RunResult &run);

} // namespace gestell::apps
