#pragma once

#include "mechanism/differentiable_element.h"
#include "mechanism/functions/formula_kinks.h"

namespace gestell::mechanism
{

/**
 * Force given by a formula of time, displacement and rate:   p = F(t, u, u')        [N or N m], so +F acts on u.
 *
 * Its kinks are guards (FormulaKinks).
 *
 * Its work is input, negative if the force brakes, because the stored part is unknown.  As structure it has K = -dF/du
 * and D = -dF/du' at the given u, at t = 0 and at rest.
 */
class FormulaForce : public DifferentiableElement<FormulaForce, 1, Branches, Structure>
{
public:
  enum Variable
  {
    time,
    displacement,
    rate,
    n_variables
  };
  enum class Along
  {
    line, ///< u in m, F in N
    angle ///< u in rad, F in N m
  };

  struct Parameters
  {
    Formula force;               ///< F of the variables above
    Along   along = Along::line; ///< names and units of the quantities
  };

  /// @throws std::invalid_argument if the formula depends on another variable.
  explicit FormulaForce(const Parameters &parameters);

  template <typename Number>
  void law(const Measures<Number> &m, const double *history, Number *p) const
  {
    const Number x[n_variables] = {Number(m.t), m.u[0], m.v[0]};
    const int    n              = parameters_.force.n_kinks();
    p[0] = n > 0 && m.by_history ? Number(parameters_.force.value(x, history) + Number(history[n]))
                                 : parameters_.force.value(x);
  }

  const Branches *branches() const override { return n_kinks() > 0 ? this : nullptr; } ///< one for each set of sides

  void engaged(const double *u, double *K, double *D) const override;
  /// With each kink in turn on the side where K, or D, is larger: exact for a sum of terms with one kink each.
  void stiffest(const double *u, double *K, double *D) const override;
  /// The same with the smallest K and D: for c max(0, u) + d u' the damper.
  void open_branch(const double *u, double *K, double *D) const override;
  bool stiffens() const override { return true; } ///< possibly; a formula is arbitrary

  /// history: side of each kink, -1 or 1; then 0, or nan after an accepted motion has left the domain of a root: roots
  /// are continued below zero only beyond a kink.
  int                   n_history() const override { return n_kinks() + 1; }
  void                  start(const LocalMotion &motion, double *history) const override;
  void                  accept(const LocalMotion &motion, double *history) const override;
  Work                  work() const override { return Work::input; }
  int                   n_guards(const double *) const override { return n_kinks(); }
  std::vector<Guard>    guards(const double *history) const override { return kinks().guards(history); }
  void                  guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  void                  transition(int i, const LocalMotion &motion, double *history) const override;
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  int          n_kinks() const { return parameters_.force.n_kinks(); }
  FormulaKinks kinks() const { return FormulaKinks(parameters_.force); }
  void         derivatives_at(double u, const double *sides, double &K, double &D) const;
  void         extreme(bool largest, double u, double &K, double &D) const;

  Parameters parameters_;
};

} // namespace gestell::mechanism
