#include "coupling/simulation/communicated_steps.h"

namespace gestell::coupling
{

CommunicatedSteps::CommunicatedSteps(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> inner)
    : system_(system), inner_(std::move(inner)), control_(dynamic_cast<ErrorControl *>(inner_.get()))
{
}

void CommunicatedSteps::begin_with(const Eigen::VectorXd &history, bool located)
{
  history_      = history;
  with_history_ = true;
  located_      = located;
}

/// Whoever drives it has started a history, which is replaced.
void CommunicatedSteps::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  if (with_history_)
  {
    system_.events().follow_history(located_);
    system_.events().restore_history(history_);
  }
  with_history_ = restarts_ = false;
  inner_->begin(t, q, v);
}

void CommunicatedSteps::advance()
{
  if (restarts_)
    inner_->restart();
  restarts_ = false;
  inner_->advance();
  if (!(inner_->time() > end_))
    return;
  inner_->cut(end_);
  restarts_ = true;
}

void CommunicatedSteps::cut(double t)
{
  inner_->cut(t);
  restarts_ = true;
}

void CommunicatedSteps::restart()
{
  inner_->restart();
  restarts_ = false;
}

} // namespace gestell::coupling
