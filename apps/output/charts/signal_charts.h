#pragma once

#include "apps/output/charts/chart.h"
#include "coupling/simulation/simulation.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

enum class ChartTopic
{
  force,  ///< N, N m
  motion, ///< m, rad and their rates
  energy, ///< J
  other
};

/// A chart of the history: file name without ending, its SVG, and what it is about.
struct SignalChart
{
  std::string name, svg;
  ChartTopic  topic;
  Chart       chart;
  bool        is_part = false; ///< of the time
};

/// Columns of a history that share a chart.
struct SignalGroup
{
  std::string              unit;
  std::vector<std::size_t> columns;
};

/// Signals of one unit share a chart while the widest moves at most 15 times as far as the narrowest, so that each
/// can be read; at most seven.  Within a unit the widest come first.
std::vector<SignalGroup> group_signals(const coupling::RunResult &run);

/// The stretch around the hardest shock: where a force with at least a third of the widest range (or else the first
/// signal) changes by the largest share of its own range within a two hundredth of the run; an eighth of the run wide,
/// a quarter of it before the shock.  Empty (begin = end) for short histories.
std::pair<double, double> main_shock(const coupling::RunResult &run);

/// One chart over the whole run for every group, for forces that the main shock shakes a second one around it.  Names:
/// forces, forces-shock, forces-2, moments, displacements, angles, energy ...
std::vector<SignalChart> signal_charts(const coupling::RunResult &run);

} // namespace gestell::apps
