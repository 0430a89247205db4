#include "apps/analysis/comparison/overlay_charts.h"

#include "apps/output/charts/signal_charts.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gestell::apps
{

namespace
{

constexpr std::size_t most_overlays = 8;
constexpr std::size_t most_copies   = 4; ///< of curves that are shown without script, too

/// Column j of the history over the time, times the factor of a unit.
Curve history_curve(const std::string &name, const coupling::RunResult &run, std::size_t j, double factor)
{
  Curve             curve;
  const std::size_t width = run.columns.size();
  curve.name              = name;
  for (std::size_t i = 0; i + width <= run.rows.size(); i += width)
    curve.add(run.rows[i], factor * run.rows[i + j]);
  return curve;
}

double size_of(const coupling::SignalSummary &signal)
{
  return std::max(std::abs(signal.min), std::abs(signal.max));
}

Chart overlay(const std::string &scene, const coupling::RunResult &run, const ComparedRun &other, SharedSignal shared)
{
  const coupling::SignalSummary &a = run.signals[shared.a], &b = other.run.signals[shared.b];
  const DisplayUnit              unit = display_unit(a.unit, std::max(size_of(a), size_of(b)));
  Chart                          chart;
  chart.width            = 880.;
  chart.height           = 230.;
  chart.title            = a.name;
  chart.x.label          = "t [s]";
  chart.y.label          = "[" + unit.unit + "]";
  Curve first            = history_curve(scene, run, shared.a + 1, unit.factor),
        second           = history_curve(other.scene, other.run, shared.b + 1, unit.factor);
  second.colour          = 1;
  second.line            = LineStyle::dashed;
  chart.panels[0].curves = {std::move(first), std::move(second)};
  return chart;
}

} // namespace

std::vector<Section::Drawing> overlay_charts(const std::string &scene, const coupling::RunResult &run,
                                             const ComparedRun &other)
{
  using Shown = Section::Drawing::Shown;
  std::vector<Section::Drawing> charts;
  const auto                    add = [&](const std::string &name, const Chart &chart, ChartLink link) {
    charts.push_back({name, chart, link, charts.size() < most_copies ? Shown::live : Shown::named});
  };
  if (run.rows.size() < 2 * run.columns.size() || other.run.rows.size() < 2 * other.run.columns.size())
    return charts;
  const auto  shock = main_shock(run);
  std::size_t n     = 0;
  for (const SharedSignal shared : shared_signals(run, other.run))
  {
    if (++n > most_overlays)
      break;
    Chart      chart  = overlay(scene, run, other, shared);
    const auto number = std::to_string(n);
    const bool force  = run.signals[shared.a].unit == "N" || run.signals[shared.a].unit == "N m";
    add("compared-" + number, chart, ChartLink::time);
    if (!force || !(shock.second > shock.first))
      continue;
    chart.title += ", around the main shock";
    std::tie(chart.x.begin, chart.x.end) = shock;
    add("compared-" + number + "-shock", chart, ChartLink::cursor);
  }
  return charts;
}

} // namespace gestell::apps
