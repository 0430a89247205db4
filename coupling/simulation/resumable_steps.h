#pragma once

#include "coupling/integration/system/error_control.h"
#include "coupling/integration/system/time_integrator.h"

#include <memory>

namespace gestell::coupling
{

/**
 * Wraps another integrator so that it can start in the middle of a motion, with the history of the elements there.
 *
 * It can hide the end of the last step from code that asks for the motion up to an instant inside the step.
 */
class ResumableSteps : public TimeIntegrator, public ErrorControl
{
public:
  ResumableSteps(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> inner);

  /// Until show_whole_step() or another step the last step appears to end at t.
  void show_until(double t);
  void show_whole_step() { partly_ = false; }
  /// The next begin() starts in the middle of a motion, with this history of the elements.
  /// @param located  laws follow it
  void begin_with(const Eigen::VectorXd &history, bool located);

  void           begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) override;
  void           advance() override;
  void           cut(double t) override { inner_->cut(t); }
  void           restart() override { inner_->restart(); }
  const Instant &instant() const override { return partly_ ? shown_ : inner_->instant(); }

  const LocalState      &local() const override { return partly_ ? shown_.local : inner_->local(); }
  double                 step_begin() const override { return inner_->step_begin(); }
  int                    parts_of_step() const override { return inner_->parts_of_step(); }
  const IntegrationWork &work() const override { return inner_->work(); }
  void                   interpolate(double t, LocalState &state) const override { inner_->interpolate(t, state); }
  void interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const override { inner_->interpolate(t, q, v); }
  void motion_at(double t, const std::vector<int> &coordinates, Eigen::VectorXd &q, Eigen::VectorXd &v) const override
  {
    inner_->motion_at(t, coordinates, q, v);
  }

  bool controls_error() const override { return control_ && control_->controls_error(); }
  void expect(double way, double speed) override { control_->expect(way, speed); }

private:
  SecondOrderSystem              &system_;
  std::unique_ptr<TimeIntegrator> inner_;
  ErrorControl                   *control_; ///< that of the inner integrator, or null
  Eigen::VectorXd                 history_;
  bool                            with_history_ = false, located_ = true, partly_ = false;
  Instant                         shown_; ///< the end of the visible part
};

} // namespace gestell::coupling
