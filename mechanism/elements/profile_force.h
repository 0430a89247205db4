#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/profile.h"

namespace gestell::mechanism
{

/**
 * Force or torque that follows a profile over time:   p = F(t)        [N or N m]
 *
 * +F acts on the measure u [m or rad].  Corners of the profile are events "next_segment".  Its work counts as input.
 */
class ProfileForce : public DifferentiableElement<ProfileForce, 1>
{
public:
  explicit ProfileForce(const Profile &profile) : profile_(profile) {}

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    p[0] = Number(profile_.value(m.by_history ? piece_of(history) : profile_.piece_at(m.t), m.t));
  }

  /// history: active piece of the profile.
  int                   n_history() const override { return 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  Work                  work() const override { return Work::input; }
  int                   n_guards(const double *history) const override { return int(profile_.ends(piece_of(history))); }
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  static std::size_t piece_of(const double *history) { return static_cast<std::size_t>(history[0]); }

  Profile profile_;
};

} // namespace gestell::mechanism
