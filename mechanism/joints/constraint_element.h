#pragma once

#include "mechanism/force_element.h"
#include "mechanism/joints/motion_law.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * What ideal joints have in common: their force p = G^T lambda is the system's, and if a MotionLaw drives them,
 * history, corners and orders are those of the law and their work is an input.
 */
class ConstraintElement : public ForceElement
{
public:
  void force(const LocalMotion &motion, const double *history, double *p) const final;
  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const final;

  /// s(u) of the equation that follows the law; 0 if none does.
  virtual double driven_value(const double *u) const { return (void)u, 0.; }

  Work work() const override { return law_ ? Work::input : Work::dissipated; }

  int                n_history() const override { return law_ ? law_->n_history() : 0; }
  void               start(const LocalMotion &motion, double *history) const override;
  int                n_guards(const double *history) const override { return law_ ? law_->n_guards(history) : 0; }
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;
  bool               command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;
  std::vector<std::string> commands() const override { return law_ ? law_->commands() : std::vector<std::string>{}; }
  void                     check_order(const SwitchCommand &order) const override;

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
