#include "apps/analysis/periodic/phase_planes.h"

#include "apps/analysis/periodic/periodic_entry.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{
constexpr int rows_of_planes = 4096; ///< of a period: shocks are short

/// Column j against its rate, n columns further; points that lie on one another are left out.
PhasePlane::Curve curve_of(const PeriodicEntry &traced, std::size_t j, std::size_t n)
{
  const SignalOrbit &x = traced.signals[j], &rate = traced.signals[n + j];
  constexpr double   seen  = 1e-3; // distance of points, of the widths of the plane, below which they are one
  const double       width = seen * (x.max - x.min), height = seen * (rate.max - rate.min);
  PhasePlane::Curve  curve;
  const std::size_t  columns = 2 * n + 1, rows = traced.rows.size() / columns;
  curve.stable = traced.solution.stable() || !traced.solution.stability_is_known();
  for (std::size_t i = 0; i < rows; ++i)
  {
    const double at = traced.rows[i * columns + 1 + j], fast = traced.rows[i * columns + 1 + n + j];
    const bool   begins = i % rows_of_planes == 0;
    if (!begins && std::abs(at - curve.x.back()) <= width && std::abs(fast - curve.rate.back()) <= height)
      continue;
    if (begins && i + 1 < rows)
      curve.begins.push_back(curve.x.size());
    curve.x.push_back(at);
    curve.rate.push_back(fast);
  }
  return curve;
}
} // namespace

std::optional<coupling::Signal> rate_of(const coupling::Signal &signal)
{
  coupling::Signal rate = signal;
  rate.name += "'";
  rate.unit += "/s";
  if (signal.element >= 0 || signal.load >= 0 || !signal.on_v.empty() || !signal.on_a.empty() || signal.computed)
    return std::nullopt;
  if (signal.measure >= 0)
  {
    if (signal.quantity != 0 || !signal.on_q.empty())
      return std::nullopt;
    rate.quantity = 1;
    rate.offset = rate.on_t = 0.;
    return rate;
  }
  if (signal.on_q.empty())
    return std::nullopt;
  rate.on_v   = signal.on_q;
  rate.on_q   = {};
  rate.offset = signal.on_t;
  rate.on_t   = 0.;
  return rate;
}

std::vector<PhasePlane> phase_planes(coupling::Machine &machine, const coupling::PeriodicProblem &problem,
                                     const std::vector<PeriodicEntry>    &entries,
                                     const std::vector<coupling::Signal> &signals)
{
  std::vector<coupling::Signal> read, rates;
  constexpr std::size_t         most_planes = 4; // two rows of charts
  constexpr std::size_t         most_curves = 6; // chosen: curves of one chart
  for (const coupling::Signal &signal : signals)
    if (const auto rate = rate_of(signal); rate && read.size() < most_planes)
    {
      read.push_back(signal);
      rates.push_back(*rate);
    }
  std::vector<PhasePlane> planes;
  for (const coupling::Signal &signal : read)
    planes.push_back({signal.name, signal.unit, {}});
  if (planes.empty())
    return planes;
  read.insert(read.end(), rates.begin(), rates.end());
  for (std::size_t k = 0; k < std::min(entries.size(), most_curves); ++k)
  {
    const coupling::PeriodicSolution &solution = entries[k].solution;
    const PeriodicEntry traced = entry_of(machine, problem, solution, read, rows_of_planes * solution.ratio);
    for (std::size_t j = 0; j < planes.size(); ++j)
    {
      planes[j].curves.push_back(curve_of(traced, j, planes.size()));
      planes[j].curves.back().solution = int(k) + 1;
    }
  }
  return planes;
}

} // namespace gestell::apps
