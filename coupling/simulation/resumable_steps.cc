#include "coupling/simulation/resumable_steps.h"

namespace gestell::coupling
{

ResumableSteps::ResumableSteps(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> inner)
    : system_(system), inner_(std::move(inner)), control_(dynamic_cast<ErrorControl *>(inner_.get()))
{
}

void ResumableSteps::begin_with(const Eigen::VectorXd &history, bool located)
{
  history_      = history;
  with_history_ = true;
  located_      = located;
}

/// Whoever drives it has started a history, which is replaced.
void ResumableSteps::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  if (with_history_)
  {
    system_.events().follow_history(located_);
    system_.events().restore_history(history_);
  }
  inner_->begin(t, q, v);
  if (with_history_)
    system_.events().accept(inner_->local()); // the history may be that of the step in which t lies
  with_history_ = restarts_ = false;
}

void ResumableSteps::advance()
{
  if (restarts_)
    inner_->restart();
  restarts_ = false;
  inner_->advance();
}

void ResumableSteps::restart()
{
  inner_->restart();
  restarts_ = false;
}

} // namespace gestell::coupling
