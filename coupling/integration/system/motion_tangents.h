#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

/// Derivatives of the measures' motion and forces, [n_u x k] each.
struct LocalTangents
{
  Eigen::MatrixXd u, v, a, p;
};

/**
 * Interface of integrators with tangents: derivatives of the motion with respect to k parameters of its start, dq/ds
 * and dq'/ds [n x k].  They are the exact derivatives of the steps made, with the matrix of these steps.
 *
 * The driver of the integrator calls:
 *
 *     begin_tangents(dq, dv)     behind TimeIntegrator::begin()
 *     carry_tangents()           behind every step or part of one, before it is accepted
 *     jump_tangents(...)         behind a transition and the restart after it
 */
class MotionTangents
{
public:
  virtual ~MotionTangents() = default;

  virtual void begin_tangents(const Eigen::MatrixXd &dq, const Eigen::MatrixXd &dv) = 0;
  virtual void carry_tangents()                                                     = 0;

  /// Forces jump from `before` to those of local(), at a time that also depends on the start: dt [1 x k] (saltation).
  ///     dx' = (x'_before - x'_behind) dt
  virtual void jump_tangents(const Eigen::VectorXd &before, const Eigen::RowVectorXd &dt) = 0;

  virtual void          tangents(Eigen::MatrixXd &dq, Eigen::MatrixXd &dv) const = 0; ///< here
  virtual LocalTangents local_tangents()                                         = 0; ///< here
  /// The derivative with respect to time, k = 1, without the explicit time dependence of laws.
  virtual LocalTangents local_rates() = 0;
};

} // namespace gestell::coupling
