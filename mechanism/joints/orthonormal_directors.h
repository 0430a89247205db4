#pragma once

#include "mechanism/constraint.h"
#include "mechanism/structure.h"

#include <Eigen/Core>

namespace gestell::mechanism
{

/**
 * Orthonormality constraints of the directors of a free spatial body:
 *
 *     g = (1/2 (d_1 . d_1 - 1), 1/2 (d_2 . d_2 - 1), 1/2 (d_3 . d_3 - 1), d_2 . d_3, d_3 . d_1, d_1 . d_2) = 0,
 *
 * d_i = e_i + u_i with the measures u = (u_1, u_2, u_3) [9, 1].  Its forces L d with a symmetric L have no torque.
 *
 * Signals: angular velocity "wx", "wy", "wz" [rad/s] about the global axes, and the rotation from the reference
 * configuration as axis times angle (0 to pi), "rx", "ry", "rz" [rad].
 *
 * Source: docs/theory/joints.md (7).
 */
class OrthonormalDirectors : public Constraint, public Structure
{
public:
  static constexpr int n_directors = 9; ///< measures

  int  n_measures() const override { return n_directors; }
  int  n_constraints() const override { return 6; }
  void constraint(const LocalMotion &motion, const double *history, double *g, double *G) const override;
  void constraint_rates(const LocalMotion &motion, const double *history, double *rate, double *bias) const override;

  const Structure *structure() const override { return this; }
  void             geometric(const LocalMotion &motion, const double *history, double *K) const override;
  bool             depends(int equation, int measure) const override;
  std::string      constraint_name(int i) const override;

  bool                  needs_multipliers(int) const override { return false; }
  std::vector<Quantity> quantities() const override;
  double                quantity(int i, const LocalMotion &motion, const double *history) const override;

  /// omega = 1/2 sum d_i x d_i'
  static Eigen::Vector3d angular_velocity(const double *u, const double *v);
  /// Measures u [9] of a rotation given as axis times angle.
  static Eigen::Matrix3d measures(const Eigen::Vector3d &rotation);
};

} // namespace gestell::mechanism
