#pragma once

#include "coupling/integration/system/constraint_jacobian.h"
#include "coupling/integration/system/motion_tangents.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <list>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * Tangents beside an integrator that has none: the variational equations of its motion,
 *
 *     M dq'' + B dq' + C dq = W dp,     du = W^T dq,     G du = 0,     dv_h = 0 of what sticks,
 *     dp = p_u du + p_v dv + p_a da                                of the elements, whose forces turn with the motion,
 *     dp = d(G^T lambda)/du du + G^T dlambda                       of the joints,
 *
 * in the integrator's own steps.  With the ratio r of a step h to the one before,
 *
 *     dq = H_q + b dv,     H_q = ((1 + r)^2 dq_1 - r^2 dq_2)/(1 + 2 r),     b = h (1 + r)/(1 + 2 r),     w = M v + B q,
 *     (M + b B + b^2 C) dq = M H_q + b H_w + b^2 W dp,
 *
 * which is BDF 2; the first step after a start or a jump takes H of its begin and b = h/2, and goes on to twice the
 * change: the midpoint rule.  Both are of second order in h: these are derivatives of the motion, not of its steps.
 *
 * Forces must not depend on multipliers.  Motions across the joints are taken out of a start, with the mass as the
 * norm, as ConsistentStart does.
 */
class VariedMotion final : public MotionTangents
{
public:
  /// Measures and equations of joints above which tangents cost more than they are worth: a step solves equations of
  /// their number, dense.
  static constexpr int most_measures = 300;

  /// Both must outlive it.
  VariedMotion(const SecondOrderSystem &system, const TimeIntegrator &integrator);
  ~VariedMotion() override;

  void          begin_tangents(const Eigen::MatrixXd &dq, const Eigen::MatrixXd &dv) override;
  void          carry_tangents() override;
  void          jump_tangents(const Eigen::VectorXd &before, const Eigen::RowVectorXd &dt) override;
  void          tangents(Eigen::MatrixXd &dq, Eigen::MatrixXd &dv) const override;
  LocalTangents local_tangents() override { return local_; }
  LocalTangents local_rates() override;

private:
  struct Point
  {
    double          t = 0.;
    Eigen::MatrixXd q, v, w; ///< [n x k]
  };
  /// What depends on b alone.
  struct Form
  {
    double                        b;
    std::unique_ptr<LinearSolver> A;
    Eigen::MatrixXd               inverse, of_mass; ///< A^-1, A^-1 M of small systems, else empty
    Eigen::MatrixXd               Y, S;             ///< b^2 A^-1 W [n x n_u], W^T Y
  };
  /// History of the formula.
  struct History
  {
    double b;
    Point  H;
  };

  using Product = void (LinearSystem::*)(const Eigen::VectorXd &, Eigen::VectorXd &) const;

  Eigen::MatrixXd     times(Product product, const Eigen::MatrixXd &dense, const Eigen::MatrixXd &X) const;
  Eigen::MatrixXd     solution(const LinearSolver &A, const Eigen::MatrixXd &F) const;
  void                respond(const Form &form, const History &history, Eigen::MatrixXd &free) const;
  const LinearSolver &mass();
  const Form         &form(double b);
  History             history(double h, bool starts) const;
  void                linearise_here();
  Eigen::MatrixXd     forces(const Form &form, const Eigen::MatrixXd &u_free, const LocalTangents &H,
                             const Eigen::MatrixXd &g) const;
  void                project(Eigen::MatrixXd &dq, Eigen::MatrixXd &dv);
  void                begin_at(Point &&point);

  const SecondOrderSystem      &system_;
  const TimeIntegrator         &integrator_;
  Eigen::MatrixXd               M_, B_, C_; ///< of small systems, else empty
  std::unique_ptr<LinearSolver> mass_;      ///< null: not needed so far
  std::list<Form>               forms_;     ///< the last one used first
  bool                          by_accelerations_ = false;
  Point                         now_, before_;
  bool                          starts_ = true; ///< before_ is not of this motion
  LocalTangents                 local_;
  LocalState                    state_, state_before_; ///< of the last two instants
  Eigen::MatrixXd               p_u_, p_v_, p_a_;      ///< [n_u x n_u]
  Eigen::MatrixXd               G_;                    ///< [n_c x n_u]
  ConstraintJacobian            jacobian_;
};

} // namespace gestell::coupling
