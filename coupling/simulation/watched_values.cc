#include "coupling/simulation/watched_values.h"

#include "coupling/integration/system/state_archive.h"
#include "coupling/integration/system/time_integrator.h"

#include <cmath>

namespace gestell::coupling
{

WatchedValues::WatchedValues(const Machine &machine, const TimeIntegrator &integrator, WatchedSignals *watched,
                             std::vector<int> coordinates)
    : machine_(machine), integrator_(integrator), watched_(watched), coordinates_(std::move(coordinates)),
      q_(Eigen::VectorXd::Zero(machine.size())), v_(q_)
{
  if (watched_)
    watched_->values.assign(watched_->signals.size(), {});
}

void WatchedValues::step()
{
  constexpr long every = 8; // steps: their cost is then some hundredths of the steps' own
  if (++steps_ % every == 0)
    look();
}

void WatchedValues::look()
{
  if (!watched_)
    return;
  const double t = integrator_.time();
  if (!coordinates_.empty())
    integrator_.motion_at(t, coordinates_, q_, v_);
  for (std::size_t i = 0; i < watched_->signals.size(); ++i)
  {
    const double value = machine_.evaluate(watched_->signals[i], q_, v_, integrator_.local());
    if (std::isfinite(value))
      watched_->values[i].take(t, value);
  }
}

void WatchedValues::exchange(StateArchive &archive)
{
  archive(steps_);
  if (watched_)
    for (WatchedValue &value : watched_->values)
      archive(value.known, value.first, value.last, value.least, value.most, value.t_least, value.t_most);
}

} // namespace gestell::coupling
