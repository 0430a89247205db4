#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/functions/user_function.h"

#include <atomic>
#include <mutex>
#include <string>

namespace gestell::mechanism
{

/**
 * Force by functions of the calling program:   p = F(t, u, u', s)        [N or N m], so +F acts on u.
 *
 * Without `derivative` the tangent is a central difference with the step 6e-6 max(|x|, 1e-3) in u and in u': the cube
 * root of the rounding of double precision, where truncation and rounding are of one size.  Its relative error is (6e-6
 * |x| / l)^2 / 6 for a law that bends over the length l, plus 1e-10.  It costs four more calls of `force` per tangent.
 *
 * Where a function throws, the law has no value, which a shorter step may avoid, as with a force that is not a number;
 * fault() has the reason.  An event occurs where its number rises through zero: it is armed while its number is
 * negative, and disarmed by the event itself.  A state or an event value without a number is lost for good: then the
 * law has no value any more, which ends a run.
 *
 * As FormulaForce its work is input; as structure it has K = -dF/du and D = -dF/du' at the given u, at t = 0, at rest,
 * in the state of the start.  Functions may be called by several threads at once.
 */
class UserForce : public DifferentiableElement<UserForce, 1, Branches, Structure>
{
public:
  enum class Along
  {
    line, ///< u in m, F in N
    angle ///< u in rad, F in N m
  };

  /// @throws std::invalid_argument without `force`, for events without values, or the reverse
  explicit UserForce(UserLaw law, Along along = Along::line);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const double x[] = {m.t, value(m.u[0]), value(m.v[0])};
    if constexpr (std::is_same_v<Number, double>)
      p[0] = force_at(x, history);
    else
    {
      double slopes[2];
      p[0] = Number(force_at(x, history));
      slopes_at(x, history, slopes);
      p[0].derivatives() = slopes[0] * m.u[0].derivatives() + slopes[1] * m.v[0].derivatives();
    }
  }

  /// Why a function failed after the instant t, or lost the state; empty: none did.
  std::string fault(double t) const;

  void engaged(const double *u, double *K, double *D) const override;
  bool stiffens() const override { return true; } ///< possibly; a function is arbitrary

  /// Only with a state or events; history: the state, then for each event 1 if it is armed, else 0.
  const Branches       *branches() const override { return n_history() + n_events() > 0 ? this : nullptr; }
  int                   n_history() const override { return n_state() + n_events(); }
  void                  start(const LocalMotion &motion, double *history) const override;
  void                  accept(const LocalMotion &motion, double *history) const override;
  Work                  work() const override { return Work::input; }
  int                   n_guards(const double *) const override { return n_events(); }
  std::vector<Guard>    guards(const double *history) const override;
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  enum class Numbered
  {
    yes, ///< what is not a number is a fault
    maybe
  };
  int    n_state() const { return int(functions_.state.size()); }
  int    n_events() const { return int(functions_.events.size()); }
  double force_at(const double *x, const double *state) const;
  void   slopes_at(const double *x, const double *state, double *slopes) const;
  void   arm(const LocalMotion &motion, double *history) const;
  void   values(const LocalMotion &motion, const double *history, double *g) const;
  void   change(const char *role, const UserFunction &function, Numbers x, double t, double *history) const;
  void   call(const char *role, const UserFunction &function, Numbers x, double t, const double *state, double *y,
              int n_y, Numbered numbered) const;

  UserLaw                   functions_;
  Along                     along_;
  mutable std::mutex        mutex_;
  mutable std::string       fault_;         ///< guarded by mutex_
  mutable double            fault_at_ = 0.; ///< its t, guarded by mutex_
  mutable std::atomic<bool> lost_{false};
};

} // namespace gestell::mechanism
