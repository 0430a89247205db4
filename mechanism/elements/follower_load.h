#pragma once

#include "mechanism/facets.h"
#include "mechanism/measures/placement.h"

#include <memory>

namespace gestell::mechanism
{

/**
 * An external load P(t) at a point x of a body along a direction e fixed in the body, such as a thrust:
 *
 *     p = P e . dx/du,     power P e . x'.
 *
 * P is that of a law of one measure, whose rate is the speed e. x'; history, events and commands are those of the law.
 * Such a load has no potential and no reaction.  Its tangent keeps e. dx/du constant within a Newton step; geometric()
 * is the remainder,
 *
 *     K_ij = -P T_ij - dP/ds' G_i sum_l T_lj u_l',     G_i = e . dx/du_i,
 *     T_ij = dG_i/du_j = de/du_j . dx/du_i + e . d^2x/du_i du_j,
 *
 * with a nonsymmetric first term of T: such a load may cause flutter.
 *
 * Source: docs/theory/joints.md (5a).
 */
class FollowerLoad : public ForceLaw, public Branches, public Structure, public Commands
{
public:
  /// @param e  unit vector, in the reference configuration
  /// @throws std::invalid_argument if the law does not have exactly one measure, or the point does not move
  FollowerLoad(const Placement &point, const Vector3d &e, std::shared_ptr<const ForceLaw> law);

  int  n_measures() const override { return point_.n_measures(); }
  void force(const LocalMotion &motion, const double *history, double *p) const override;
  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const override;
  Work work() const override { return law_->work(); }

  const Structure *structure() const override { return this; }
  void             geometric(const LocalMotion &motion, const double *history, double *K) const override;

  /// Those of the law.
  const Branches *branches() const override { return branches_ ? this : nullptr; }
  const Commands *commands() const override { return commands_ ? this : nullptr; }

  std::vector<std::string> command_names() const override { return commands_->command_names(); }
  void                     check_order(const SwitchCommand &order) const override { commands_->check_order(order); }
  bool command(const SwitchCommand &order, const LocalMotion &motion, double *history) const override;

  int                n_history() const override { return branches_->n_history(); }
  void               start(const LocalMotion &motion, double *history) const override;
  int                n_guards(const double *history) const override { return branches_->n_guards(history); }
  std::vector<Guard> guards(const double *history) const override { return branches_->guards(history); }
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void               transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override { return law_->quantities(); }
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  struct Kinematics
  {
    double s = 0., rate = 0., acceleration = 0.;
    double G[Placement::max_measures];

    LocalMotion motion(const LocalMotion &of) const
    {
      return {of.t, &s, &rate, &acceleration, nullptr, of.by_history, nullptr};
    }
  };
  Kinematics kinematics_of(const LocalMotion &motion) const;

  Placement                       point_;
  Vector3d                        e_;
  std::shared_ptr<const ForceLaw> law_;

  // Of the law.
  const Branches *branches_ = law_->branches();
  const Commands *commands_ = law_->commands();
};

} // namespace gestell::mechanism
