#include "apps/session/main_peak.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

/// Inserts the state among the saved ones, if there are any.
void add_picture(const coupling::KeptState &kept, coupling::RunResult &run)
{
  auto      &times = run.picture_times;
  const auto place = std::lower_bound(times.begin(), times.end(), kept.t);
  if (times.empty() || run.picture_velocities.size() != times.size() || (place != times.end() && *place == kept.t))
    return;
  const auto n = place - times.begin();
  times.insert(place, kept.t);
  run.picture_states.insert(run.picture_states.begin() + n, kept.q);
  run.picture_velocities.insert(run.picture_velocities.begin() + n, kept.v);
  if (run.picture_forces.size() + 1 == times.size())
    run.picture_forces.insert(run.picture_forces.begin() + n, kept.p);
}

} // namespace

int main_signal(const std::vector<coupling::Signal> &signals)
{
  const auto force =
      std::find_if(signals.begin(), signals.end(), [](const auto &signal) { return signal.unit == "N"; });
  return signals.empty() ? -1 : force == signals.end() ? 0 : static_cast<int>(force - signals.begin());
}

void ask_for_peak(const std::vector<coupling::Signal> &signals, coupling::StateRequest &states)
{
  if (const int signal = main_signal(signals); signal >= 0)
    for (const bool largest : {true, false})
      states.extremes.push_back({signal, largest});
}

std::optional<PeakState> taken_peak(const std::vector<coupling::Signal> &signals, coupling::RunResult &run)
{
  const int signal = main_signal(signals);
  if (signal < 0 || run.states.extremes.size() < 2 || run.signals.empty())
    return {};
  const coupling::KeptState smallest = run.states.extremes.back();
  run.states.extremes.pop_back();
  const coupling::KeptState largest = run.states.extremes.back();
  run.states.extremes.pop_back();
  const coupling::SignalSummary &reported = run.signals[static_cast<std::size_t>(signal)];
  const bool                     up       = std::abs(reported.max) >= std::abs(reported.min);
  const coupling::KeptState     &kept     = up ? largest : smallest;
  if (kept.q.size() == 0)
    return {};
  add_picture(kept, run);
  return PeakState{reported.name, reported.unit, up ? reported.max : reported.min, kept.t, kept.q};
}

} // namespace gestell::apps
