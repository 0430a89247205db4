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

/// A chart of the history: file name without extension, its SVG, and its caption.
struct SignalChart
{
  std::string name, svg;
  ChartTopic  topic;
  Chart       chart;
  bool        is_part = false; ///< shows only a part of the time
};

/// Columns of a history that share a chart.
struct SignalGroup
{
  std::string              unit;
  std::vector<std::size_t> columns;
};

/// Groups signals of one unit into charts: at most seven per chart, and the widest range is at most 15 times the
/// narrowest, so that each signal can be read.  Within a unit the widest come first.
std::vector<SignalGroup> group_signals(const coupling::RunResult &run);

/// Window [s] around the hardest shock: where a force with at least a third of the widest range (or else the first
/// signal) changes by the largest share of its own range within 1/200 of the run.  The window spans an eighth of the
/// run, a quarter of it before the shock.  Empty (begin = end) for short histories.
std::pair<double, double> main_shock(const coupling::RunResult &run);

/// One chart over the whole run for every group; forces that react to the main shock get a second chart around it.
/// Names: forces, forces-shock, forces-2, moments, displacements, angles, energy ...
std::vector<SignalChart> signal_charts(const coupling::RunResult &run);

} // namespace gestell::apps
