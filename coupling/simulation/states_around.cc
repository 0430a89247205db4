#include "coupling/simulation/states_around.h"

#include "coupling/integration/system/state_archive.h"
#include "coupling/simulation/forces_on_measures.h"
#include "coupling/simulation/run_state.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

constexpr std::size_t reach   = 96;   ///< states of a scale on either side of an extreme
constexpr double      rounded = 1e-9; ///< of a spacing: rounding of times

} // namespace

StatesAround::StatesAround(const Machine &machine, const TimeIntegrator &integrator, const RunOptions &options,
                           const std::vector<SignalSummary> &signals, KeptStates &kept)
    : machine_(machine), integrator_(integrator), wanted_(options.states.around), signals_(signals), kept_(kept),
      begin_(options.begin)
{
  if (wanted_.empty())
    return;
  constexpr double parts_of_run = 20000.; // as fine as pictures of a shock need
  constexpr double coarser      = 8.;     // from scale to scale
  double           spacing      = (options.end - options.begin) / parts_of_run;
  constexpr int    n_scales     = 3; // 1/20000, 1/2500 and 1/300 of the run: blows, their echoes, swings
  for (int i = 0; i < n_scales; ++i, spacing *= coarser)
  {
    scales_.push_back({spacing});
    scales_.back().kept.resize(wanted_.size());
  }
  seen_.assign(wanted_.size(), begin_);
  local_.resize(machine);
}

double StatesAround::time_of(std::size_t extreme) const
{
  const SignalSummary &signal = signals_[std::size_t(wanted_[extreme].signal)];
  return wanted_[extreme].largest ? signal.t_max : signal.t_min;
}

void StatesAround::follow()
{
  if (wanted_.empty())
    return;
  const double end = integrator_.time();
  for (Scale &scale : scales_)
    for (double t; (t = begin_ + double(scale.next) * scale.spacing) <= end + rounded * scale.spacing; ++scale.next)
      store(std::min(t, end), scale);
  forget();
}

/// Replaces the oldest state of the ring.
void StatesAround::store(double t, Scale &scale)
{
  if (scale.ring.size() <= 2 * reach)
    scale.ring.emplace_back();
  KeptState &state = scale.ring[std::size_t(scale.next) % (2 * reach + 1)];
  if (state.q.size() > 0)
    leave(state, scale);
  state.t = t;
  if (t < integrator_.time())
  {
    state.q.resize(integrator_.instant().q.size());
    state.v.resize(state.q.size());
    const double inside = std::max(t, integrator_.step_begin());
    integrator_.interpolate(inside, state.q, state.v);
    integrator_.interpolate(inside, local_);
    forces_on_measures(machine_, local_, state.p);
    return;
  }
  state.q = integrator_.instant().q;
  state.v = integrator_.instant().v;
  forces_on_measures(machine_, integrator_.local(), state.p);
}

/// A state leaves the ring: it is kept if it is near an extreme.
void StatesAround::leave(const KeptState &state, Scale &scale)
{
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (std::abs(state.t - time_of(i)) <= double(reach) * scale.spacing)
      scale.kept[i].push_back(state);
}

/// Removes states near an extreme that another one has exceeded.
void StatesAround::forget()
{
  for (std::size_t i = 0; i < wanted_.size(); ++i)
  {
    if (time_of(i) == seen_[i])
      continue;
    seen_[i] = time_of(i);
    for (Scale &scale : scales_)
    {
      auto &kept = scale.kept[i];
      kept.erase(std::remove_if(kept.begin(), kept.end(),
                                [&](const KeptState &state)
                                { return std::abs(state.t - seen_[i]) > double(reach) * scale.spacing; }),
                 kept.end());
    }
  }
}

void StatesAround::finish()
{
  forget();
  kept_.around.assign(wanted_.size(), {});
  for (std::size_t i = 0; i < wanted_.size(); ++i)
  {
    auto &around = kept_.around[i];
    for (Scale &scale : scales_)
    {
      around.insert(around.end(), scale.kept[i].begin(), scale.kept[i].end());
      for (const KeptState &state : scale.ring)
        if (std::abs(state.t - time_of(i)) <= double(reach) * scale.spacing)
          around.push_back(state);
    }
    std::sort(around.begin(), around.end(), [](const KeptState &a, const KeptState &b) { return a.t < b.t; });
    around.erase(std::unique(around.begin(), around.end(),
                             [](const KeptState &a, const KeptState &b) { return b.t - a.t <= rounded * (b.t + a.t); }),
                 around.end());
  }
}

void StatesAround::Scale::exchange(StateArchive &archive)
{
  archive(next, ring, kept);
}

void StatesAround::exchange(StateArchive &archive)
{
  archive(scales_, seen_);
}

} // namespace gestell::coupling
