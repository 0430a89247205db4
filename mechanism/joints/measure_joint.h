#pragma once

#include "mechanism/joints/constraint_element.h"
#include "mechanism/measures/combined_measure.h"

namespace gestell::mechanism
{

/**
 * An ideal joint with one equation for one scalar of the motion:
 *
 *     g(t, u) = s(u) - offset - law(t) = 0,     p = G^T lambda.
 *
 * With s = y - f(x) it is a cam or an indexing drive, with other sums a screw, a rolling wheel, a rack, a gear on a
 * carrier; with a law it prescribes the motion of s.  lambda is the force [N] (torque [N m]) on s: with a position
 * function that on y, while  -f' lambda  acts on x.
 *
 * Signals: lambda by its name; with a position function "reaction", the force on x; for a driven joint "power" [W], its
 * input.
 *
 * Source: docs/theory/position_functions.md (3).
 */
class MeasureJoint : public ConstraintElement
{
public:
  struct Parameters
  {
    CombinedMeasure measure;                    ///< s
    double          offset = 0.;                ///< [m or rad]
    std::string     name = "force", unit = "N"; ///< of lambda
    std::string     reaction_unit = "N m";      ///< of the force on x
  };

  explicit MeasureJoint(const Parameters &parameters, std::shared_ptr<const MotionLaw> law = nullptr);

  int    n_measures() const override { return measure().n_measures(); }
  int    n_constraints() const override { return 1; }
  void   constraint(const LocalMotion &motion, const double *history, double *g, double *G) const override;
  void   constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const override;
  double driven_value(const double *u) const override;
  double size_of_terms() const override;
  std::string constraint_name(int) const override { return parameters_.name; }
  void        geometric(const LocalMotion &motion, const double *history, double *K) const override;

  const Branches *branches() const override { return is_driven() || measure().n_guards() > 0 ? this : nullptr; }
  /// history: that of the law, then that of the position function.
  int  n_history() const override { return ConstraintElement::n_history() + measure().n_history(); }
  void start(const LocalMotion &motion, double *history) const override;
  int  n_guards(const double *history) const override
  {
    return ConstraintElement::n_guards(history) + measure().n_guards();
  }
  std::vector<Guard> guards(const double *history) const override;
  void               guard_values(const LocalMotion &motion, const double *history, double *g) const override;
  /// @throws std::domain_error if function or law, or their slopes, jump
  void transition(int i, const LocalMotion &motion, double *history) const override;

  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  const CombinedMeasure &measure() const { return parameters_.measure; }
  /// The part of the history that belongs to the position function; null if the motion decides.
  const double *of_function(const LocalMotion &motion, const double *history) const
  {
    return motion.by_history ? history + ConstraintElement::n_history() : nullptr;
  }

  Parameters parameters_;
};

} // namespace gestell::mechanism
