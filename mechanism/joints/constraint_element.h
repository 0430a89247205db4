#pragma once

#include "mechanism/branches.h"
#include "mechanism/commands.h"
#include "mechanism/constraint.h"
#include "mechanism/joints/motion_law.h"
#include "mechanism/structure.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * Base of ideal joints: if driven by a MotionLaw, history, corners and commands are those of the law and their work is
 * an input.
 */
class ConstraintElement : public Constraint, public Branches, public Structure, public Commands
{
public:
  /// s(u) of the equation that follows the law; 0 if none does.
  virtual double driven_value(const double *u) const { return (void)u, 0.; }

  Work work() const override { return law_ ? Work::input : Work::dissipated; }

  const Branches  *branches() const override { return law_ ? this : nullptr; }
  const Structure *structure() const override { return this; } ///< geometric
  const Commands  *commands() const override { return law_ ? this : nullptr; }

  int                n_history() const override { return law_ ? law_->n_history() : 0; }
  void               start(const LocalMotion &motion, double *history) const override;
  int                n_guards(const double *history) const override { return law_ ? law_->n_guards(history) : 0; }
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;
  bool               command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> command_names() const override { return law_->commands(); }
  void                     check_order(const SwitchCommand &order) const override { law_->check_order(order); }

protected:
  explicit ConstraintElement(std::shared_ptr<const MotionLaw> law) : law_(std::move(law)) {}

  bool             is_driven() const { return law_ != nullptr; }
  PrescribedMotion prescribed(double t, const double *history) const
  {
    return law_ ? law_->at(t, history) : PrescribedMotion{};
  }

private:
  std::shared_ptr<const MotionLaw> law_;
};

} // namespace gestell::mechanism
