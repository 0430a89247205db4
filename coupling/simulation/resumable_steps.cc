#include "coupling/simulation/resumable_steps.h"

namespace gestell::coupling
{

ResumableSteps::ResumableSteps(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> inner)
    : system_(system), inner_(std::move(inner)), control_(dynamic_cast<ErrorControl *>(inner_.get()))
{
  shown_.q.setZero(system.linear().size());
  shown_.v = shown_.q;
  shown_.local.resize(system);
}

void ResumableSteps::begin_with(const Eigen::VectorXd &history, bool located)
{
  history_      = history;
  with_history_ = true;
  located_      = located;
}

/// The driver has started a history, which is replaced here.
void ResumableSteps::begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  partly_ = false;
  if (with_history_)
  {
    system_.events().follow_history(located_);
    system_.events().restore_history(history_);
  }
  inner_->begin(t, q, v);
  if (with_history_)
    system_.events().accept(inner_->local()); // the history may be that of the step that contains t
  with_history_ = false;
}

void ResumableSteps::advance()
{
  partly_ = false;
  inner_->advance();
}

void ResumableSteps::show_until(double t)
{
  inner_->interpolate(t, shown_.local);
  inner_->interpolate(t, shown_.q, shown_.v);
  shown_.t = shown_.local.t = t;
  system_.forces().force(shown_.local, shown_.local.p);
  partly_ = true;
}

} // namespace gestell::coupling
