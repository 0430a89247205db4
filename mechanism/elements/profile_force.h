#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/functions/commanded_profile.h"
#include "mechanism/functions/input_value.h"

#include <memory>

namespace gestell::mechanism
{

/**
 * Force or torque with a given time history: p = F(t)        [N or N m]
 *
 * +F acts on the measure u [m or rad].  Corners of the profile are events.  Its work is input.  Alternatively F is an
 * external input, without commands.
 */
class ProfileForce : public DifferentiableElement<ProfileForce, 1, Branches, Commands>
{
public:
  explicit ProfileForce(const CommandedProfile &course) : course_(course) {}
  explicit ProfileForce(std::shared_ptr<InputValue> input) : input_(std::move(input)) {}

  const std::shared_ptr<InputValue> &input() const { return input_; } ///< null: it follows its profile

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    p[0] = Number(input_ ? input_->at(m.t) : course_.at(m.t, m.by_history, history).value);
  }

  int                n_history() const override { return course_.n_history(); }
  void               start(const LocalMotion &motion, double *history) const override;
  void               resume(const LocalMotion &motion, double *history) const override;
  Work               work() const override { return Work::input; }
  int                n_guards(const double *history) const override { return course_.n_guards(history); }
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;
  bool               command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override;
  std::vector<Quantity>    quantities() const override;
  double                   quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  CommandedProfile            course_;
  std::shared_ptr<InputValue> input_;
};

} // namespace gestell::mechanism
