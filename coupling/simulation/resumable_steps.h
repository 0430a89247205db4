#pragma once

#include "coupling/integration/system/error_control.h"
#include "coupling/integration/system/time_integrator.h"

#include <memory>

namespace gestell::coupling
{

/**
 * The steps of another integrator, which may begin in the midst of a motion: with the history that elements have there.
 *
 * Where loads jumped that no law tells of, the past is forgotten before the next step.
 */
class ResumableSteps : public TimeIntegrator, public ErrorControl
{
public:
  ResumableSteps(SecondOrderSystem &system, std::unique_ptr<TimeIntegrator> inner);

  /// The next step begins with other loads.
  void load_jumped() { restarts_ = true; }
  /// The next begin() is one in the midst of a motion, with this history of the elements.
  /// @param located  laws follow it
  void begin_with(const Eigen::VectorXd &history, bool located);

  void           begin(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v) override;
  void           advance() override;
  void           cut(double t) override { inner_->cut(t); }
  void           restart() override;
  const Instant &instant() const override { return inner_->instant(); }

  const LocalState      &local() const override { return inner_->local(); }
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
  ErrorControl                   *control_; ///< of it, or null
  Eigen::VectorXd                 history_;
  bool                            with_history_ = false, located_ = true, restarts_ = false;
};

} // namespace gestell::coupling
