#include "coupling/integration/events/motion.h"

#include "coupling/integration/system/state_archive.h"

#include <cmath>

namespace gestell::coupling
{

Motion::Motion(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> integrator)
    : system_(system), integrator_(std::move(integrator))
{
}

void Motion::watch(RunObserver &observer)
{
  observers_.push_back(&observer);
  if (driver_)
    observer.begin();
}

void Motion::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const EventOptions &events)
{
  if (driver_)
  {
    chattering_ += driver_->chattering_steps();
    chattering_time_ += driver_->chattering_time();
  }
  driver_.emplace(system_, *integrator_, events, observers_);
  constexpr double rounding = 1e-12; // share of a run that the sum of its steps may leave
  finish_                   = std::isfinite(events.end) ? events.end - rounding * (events.end - t) : events.end;
  driver_->begin(t, q, v);
  for (RunObserver *observer : observers_)
    observer->begin();
}

void Motion::exchange(StateArchive &archive)
{
  archive(*driver_, chattering_, chattering_time_);
  for (RunObserver *observer : observers_)
    archive(*observer);
}

} // namespace gestell::coupling
