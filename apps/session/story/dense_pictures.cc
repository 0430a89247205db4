#include "apps/session/story/dense_pictures.h"

#include "apps/session/history_rows.h"
#include "apps/session/story/turning_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

namespace
{

void insert_picture(const coupling::KeptState &state, coupling::RunResult &run)
{
  const auto n =
      std::lower_bound(run.picture_times.begin(), run.picture_times.end(), state.t) - run.picture_times.begin();
  if (run.picture_forces.size() == run.picture_times.size())
    run.picture_forces.insert(run.picture_forces.begin() + n, state.p);
  run.picture_times.insert(run.picture_times.begin() + n, state.t);
  run.picture_states.insert(run.picture_states.begin() + n, state.q);
  run.picture_velocities.insert(run.picture_velocities.begin() + n, state.v);
}

bool has_picture_near(const coupling::RunResult &run, double t, double reach)
{
  const auto after = std::lower_bound(run.picture_times.begin(), run.picture_times.end(), t - reach);
  return after != run.picture_times.end() && *after <= t + reach;
}

double half_swing(const coupling::RunResult &run, const PeakState &peak)
{
  const HistoryRows   rows(run);
  const std::size_t   column = rows.column(peak.signal);
  std::vector<double> t, y;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    t.push_back(rows.t(i));
    y.push_back(rows.at(i, column));
  }
  return half_period_at(t, y, peak.t);
}

} // namespace

void add_dense_pictures(coupling::RunResult &run, PeakState &peak)
{
  peak.half_swing = half_swing(run, peak);
  if (!(peak.half_swing > 0.) || run.states.around.size() < 2 || run.picture_times.empty() ||
      run.picture_velocities.size() != run.picture_times.size())
    return;
  const bool       largest   = peak.value >= 0.;
  constexpr double of_period = 1. / 16.; // distance of pictures: a swing is seen as smooth
  const double     period = 2. * peak.half_swing, step = of_period * period;
  double           last = -std::numeric_limits<double>::infinity();
  for (const coupling::KeptState &state : run.states.around[largest ? 0 : 1])
  {
    constexpr double periods = 1.5;  // before and after the peak: the impact and the motion around it
    constexpr double uneven  = 0.02; // allowed distance of states from their grid, relative to its spacing
    if (std::abs(state.t - peak.t) > periods * period || state.t < last + (1. - uneven) * step)
      continue;
    last                       = state.t;
    constexpr double not_again = 0.3; // of their distance: there is a picture already
    if (!has_picture_near(run, state.t, not_again * step))
      insert_picture(state, run);
  }
}

} // namespace gestell::apps
