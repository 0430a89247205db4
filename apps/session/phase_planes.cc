#include "apps/session/phase_planes.h"

#include "apps/session/periodic_answer.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{
constexpr std::size_t most_planes = 4, most_curves = 6;
constexpr int         rows_of_planes = 512; ///< of a period
} // namespace

std::optional<coupling::Signal> rate_of(const coupling::Signal &signal)
{
  coupling::Signal rate = signal;
  rate.name += "'";
  rate.unit += "/s";
  if (signal.element >= 0 || signal.load >= 0 || !signal.on_v.empty() || !signal.on_a.empty())
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
      PhasePlane::Curve curve{int(k) + 1, solution.stable() || !solution.stability_is_known(), {}, {}, {}};
      for (int period = 0; period < solution.ratio; ++period)
        curve.begins.push_back(std::size_t(period) * rows_of_planes);
      for (std::size_t i = 0; i < traced.rows.size(); i += read.size() + 1)
      {
        curve.x.push_back(traced.rows[i + 1 + j]);
        curve.rate.push_back(traced.rows[i + 1 + planes.size() + j]);
      }
      planes[j].curves.push_back(std::move(curve));
    }
  }
  return planes;
}

} // namespace gestell::apps
