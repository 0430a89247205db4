#pragma once

#include "mechanism/joints/constraint_element.h"
#include "mechanism/measures/point_along.h"
#include "mechanism/measures/relative_measure.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * An ideal joint between two points on two bodies: equations g(t, u) = s(u) - f(t) = 0 of their measures u = (u_1,
 * u_2), in relative measures s such as a . (x_2 - x_1) or |x_2 - x_1|.
 *
 * f is constant, or follows a MotionLaw: then the joint is a drive, whose work is an input.  The multiplier lambda_i is
 * the force [N] (torque [N m]) that increases s: for `along` the force on body 2 along a, for `distance` the
 * compressive force of the rod, for `ratio` the force on a measure with c_i = 1.
 *
 * Source: docs/theory/joints.md (3).
 */
class IdealJoint : public ConstraintElement
{
public:
  struct Equation
  {
    std::string     name;        ///< for messages and signals: "fx"
    std::string     unit = "N";  ///< of its multiplier
    RelativeMeasure measure;     ///< s
    double          offset = 0.; ///< f(t) = offset, + law(t) if driven
    bool            driven = false;
  };

  /// @throws std::invalid_argument without equations, for a wrong number of ratios, or driven equations without a law
  IdealJoint(const Placement &first, const Placement &second, std::vector<Equation> equations,
             std::shared_ptr<const MotionLaw> law = nullptr);

  int n_measures() const override { return first_.n_measures() + second_.n_measures(); }
  int n_constraints() const override { return int(equations_.size()); }

  void   constraint(const LocalMotion &motion, const double *history, double *g, double *G) const override;
  void   constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const override;
  double size_of_terms() const override;
  void   geometric(const LocalMotion &motion, const double *history, double *K) const override;
  std::array<int, 2> angles() const override;
  bool               depends(int equation, int measure) const override;
  std::string        constraint_name(int i) const override { return equations_[i].name; }

  double driven_value(const double *u) const override;

  /// Signals: every multiplier by the name of its equation, then "resultant", the magnitude of all forces.
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

private:
  /// -a . x_1 and a . x_2 of an equation along a direction a fixed in space: the usual one of a pin.
  struct Plain
  {
    PointAlong first, second;
  };
  /// Both points at an instant, as far as the equations need them; v null: without rates.
  struct Points
  {
    Points(const IdealJoint &joint, const LocalMotion &motion, const double *v);
    const double          *u_1, *u_2, *v_1, *v_2;
    Turn                   turn_1, turn_2;
    Placement::MovedVector x_1, x_2;
  };

  Placement                         first_, second_;
  std::vector<Equation>             equations_;
  std::vector<std::optional<Plain>> plain_; ///< of each equation
  int                               n_plain_ = 0;
};

} // namespace gestell::mechanism
