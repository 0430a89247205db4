#include "coupling/simulation/extreme_states.h"
#include "coupling/integration/system/state_archive.h"
#include "coupling/simulation/run_state.h"

#include "coupling/simulation/forces_on_measures.h"
#include "coupling/simulation/run_result.h"

#include <algorithm>

namespace gestell::coupling
{

ExtremeStates::ExtremeStates(const Machine &machine, const TimeIntegrator &integrator, const StateRequest &request,
                             double begin, const std::vector<SignalSummary> &signals, KeptStates &kept)
    : machine_(machine), integrator_(integrator), request_(request), signals_(signals), kept_(kept),
      idle_(request.empty()), begin_(begin)
{
  if (!idle_)
    local_.resize(machine);
  kept_.at.resize(request.at.size());
  kept_.extremes.resize(request.extremes.size());
  for (std::size_t i = 0; i < request.at.size(); ++i)
    kept_.at[i].t = request.at[i];
}

Eigen::VectorXd ExtremeStates::state(double t)
{
  if (t >= integrator_.time())
  {
    v_ = integrator_.instant().v;
    forces_on_measures(machine_, integrator_.local(), p_);
    return integrator_.instant().q;
  }
  q_.resize(integrator_.instant().q.size());
  v_.resize(q_.size());
  const double inside = std::max(t, integrator_.step_begin());
  integrator_.interpolate(inside, q_, v_);
  integrator_.interpolate(inside, local_);
  forces_on_measures(machine_, local_, p_);
  return q_;
}

void ExtremeStates::follow()
{
  if (idle_)
    return;
  const double end = integrator_.time() + 1e-12 * (integrator_.time() - begin_); // instants are exact to rounding
  if (request_.step > 0.)
    for (double t; (t = begin_ + double(kept_.grid.size()) * request_.step) <= end;)
      kept_.grid.push_back({t, state(t)});
  for (; next_at_ < request_.at.size() && request_.at[next_at_] <= end; ++next_at_)
    kept_.at[next_at_].q = state(request_.at[next_at_]);
  for (std::size_t i = 0; i < request_.extremes.size(); ++i)
  {
    const SignalSummary &signal = signals_[request_.extremes[i].signal];
    const double         t      = request_.extremes[i].largest ? signal.t_max : signal.t_min;
    KeptState           &kept   = kept_.extremes[i];
    // Extremes that changed since the last call are within the last step.
    if (kept.q.size() > 0 && kept.t == t)
      continue;
    kept   = {t, state(t)};
    kept.v = v_;
    kept.p = p_;
  }
}

void ExtremeStates::exchange(StateArchive &archive)
{
  archive(kept_.grid, kept_.at, kept_.extremes, next_at_);
}

} // namespace gestell::coupling
