#pragma once

#include "mechanism/force_law.h"
#include "mechanism/joints/ideal_joint.h"
#include "mechanism/measures/relative_measure.h"
#include "mechanism/structure.h"

#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * A compliant joint: instead of the constraint s(u) = s_0 of an ideal joint between the same two points it has the
 * force
 *
 *     p = sum_i G_i^T lambda_i,     lambda_i = -k_i (s_i - s_0i) - d_i s_i',     G_i = ds_i/du
 *
 * of all its relative measures s_i.  lambda_i has the meaning of an ideal joint's multiplier, the force [N] (torque [N
 * m]) that increases s_i, and converges to it as k grows.  1/2 k s^2 is stored, d s'^2 dissipated.
 *
 * With an s along an axis that body 1 carries, lambda depends on the motion of body 2 relative to body 1 only, and G
 * contains the moment of the force about body 1: a common rotation is not damped. Along an axis fixed in space damping
 * brakes a common rotation by d s^2 omega.
 *
 * The tangent keeps G constant, as that of a TransmittedElement; geometric() is the remainder.
 *
 * Source: docs/theory/joints.md (11).
 */
class CompliantJoint : public ForceLaw, public Structure
{
public:
  /// Constraint of an ideal joint on a measure, with stiffness and damping.
  struct Equation
  {
    IdealJoint::Equation demand;
    double               stiffness = 0.; ///< k [N/m, N m/rad], >= 0
    double               damping   = 0.; ///< d [N s/m, N m s/rad], >= 0
    /// For `along` an axis fixed to body 1: the signal is the force along the axis in its reference direction, the sum
    /// of all such equations.
    bool told_as_described = false;
  };

  static constexpr int max_equations = 6;

  /// @throws std::invalid_argument without equations, for more than six or driven ones, negative stiffness or damping
  CompliantJoint(const Placement &first, const Placement &second, std::vector<Equation> equations);

  int  n_measures() const override { return first_.n_measures() + second_.n_measures(); }
  void force(const LocalMotion &motion, const double *history, double *p) const override;
  void tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
               double *dp) const override;
  void derivatives(const LocalMotion &motion, const double *history, double *p, double *dp_du,
                   double *dp_dv) const override;

  const Structure *structure() const override { return this; }
  void             engaged(const double *u, double *K, double *D) const override;
  void             geometric(const LocalMotion &motion, const double *history, double *K) const override;

  double size_of_terms() const override { return first_.size() + second_.size(); }
  double stored_energy(const LocalMotion &motion, const double *history) const override;
  double stored_power(const LocalMotion &motion, const double *history) const override;

  /// Signals as those of the ideal joint: every force by the name of its equation, then "resultant".
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  int n_equations() const { return int(equations_.size()); }
  /// Deviation of measure i from s_0 and its rate; initial conditions make it zero.  gradient [k]
  RelativeMeasure::Value opening(int i, const double *u, const double *v, double *gradient) const;

private:
  /// lambda_i, G [k x n, column major] of all equations; the two points are evaluated only once.
  struct Kinematics
  {
    double s[max_equations], rate[max_equations], lambda[max_equations];
    double G[max_equations * PlacedMeasure::max_measures];
  };
  void   kinematics_of(const double *u, const double *v, Kinematics &kinematics) const;
  double along_as_described(int i, const double *u, const Kinematics &kinematics) const;
  /// p = G^T lambda
  void spread(const Kinematics &kinematics, double *p) const;
  /// matrix = sum_i c_i G_i^T G_i, c_i = w_k k_i + w_d d_i
  void add_up(const Kinematics &kinematics, double w_k, double w_d, double *matrix) const;

  Placement             first_, second_;
  std::vector<Equation> equations_;
};

} // namespace gestell::mechanism
