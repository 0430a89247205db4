#pragma once

#include "coupling/integration/step/compliance.h"
#include "coupling/integration/step/saddle_matrix.h"
#include "coupling/integration/system/small_lu.h"
#include "coupling/integration/system/time_integrator.h"

namespace gestell::coupling
{

class CondensedMatrix;
class ImplicitStep;
class StateArchive;

/// Sets the rates of sticking measures in v [n] to those of sticking, free of rounding, so that a motion released there
/// starts exactly at the zero of the guard by which it would stick again.
void keep_held_rates(const SecondOrderSystem &system, Eigen::VectorXd &v);

/**
 * The consistent acceleration for q and q' at an instant:
 *
 *     M a = f_t + W p(t, u, u', u'') - B q' - C q.
 *
 * Condensed to the measures, with D = W^T M^-1 W [n_u x n_u]:  u'' = u''_free + D p, solved by Newton's method if
 * forces depend on u''.  A sticking measure has u'' = 0, and its force p follows from the same equation (index 1).  In
 * the same way the multipliers of ideal joints follow from g'' = G u'' + bias = 0,
 *
 *     G D G^T lambda = -bias - G (u''_free + D p),
 *
 * with the accuracy of q and q', for any integrator.
 *
 * With many joints the same equations are solved uncondensed, for a and lambda at once, by SaddleMatrix with A = M, f
 * = 1.
 *
 * Methods with the acceleration in their state start with it; they require a regular M.
 */
class ConsistentStart
{
public:
  /// Factorises M.
  /// @param method  for messages: "Newmark"
  /// @throws std::invalid_argument if M is singular, with a coordinate without mass
  ConsistentStart(const SecondOrderSystem &system, const std::string &method,
                  JointSolver joints = JointSolver::automatic);
  ~ConsistentStart();

  /// Computes a [n] at local.t; local.u and local.v must belong to q, v [n].  Fills local.a, local.p and local.lambda.
  /// @throws ConvergenceFailure if p depends on u'' and Newton does not converge, or if joints depend on each other
  void solve(const Eigen::VectorXd &q, const Eigen::VectorXd &v, Eigen::VectorXd &a, LocalState &local,
             IntegrationWork &work);

  /// Writes the multipliers, forces and u'' where a step ends into local, as solve() computes them; the last solve()
  /// was in the same branches of all forces.  Almost everything is known there: p and G from the step, lambda about.
  /// Condensed, u'' follows from tables. Sparse, the step's own factor corrects lambda until
  ///
  ///     g'' = G u'' + bias,     M a = f_t + W p - B q' - C q
  ///
  /// is zero to 1e-12 of its terms; one correction is usual, because A differs from M by terms of the order of h.  If
  /// these are large, the factor is that of M with the same G.  If something sticks, or if a force
  /// depends on u'' or on multipliers, solve() is called.
  void find_multipliers(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ImplicitStep &step, LocalState &local,
                        IntegrationWork &work);

  /// Writes the forces of sticking measures, for which u'' = 0, into local.p, at any instant of a motion.  The result
  /// is that of solve(); without joints and without forces that depend on u'' it needs only one product per sticking
  /// measure:
  ///
  ///     D_hh p_h = -(M^-1 W_h)^T (f_t - B q' - C q) - D_ho p_o.
  ///
  /// The branches must be those of the last solve().
  void hold(const Eigen::VectorXd &q, const Eigen::VectorXd &v, LocalState &local, IntegrationWork &work);

  /// Projects q to the nearest position with g(t, u) = 0, then v to the nearest velocity with G u' + rate = 0, both in
  /// the norm of the kinetic energy; updates local.u and local.v.
  /// @throws ConvergenceFailure if joints are redundant or cannot be assembled
  void project(Eigen::VectorXd &q, Eigen::VectorXd &v, LocalState &local);

  /// Data collected about the forces; matrices of sticking measures are computed again.
  void exchange(StateArchive &archive);

private:
  static constexpr double converged        = 1e-12; ///< correction of u'', relative to the terms of its sum
  static constexpr int    max_iterations   = 25;
  static constexpr int    most_by_friction = 8 * max_iterations; ///< with friction in joints: linear convergence
  static constexpr int    most_corrections = 3; ///< by the step's factor: more cost as much as a factor of M

  int               most_iterations() const;
  [[noreturn]] void fail_unconverged(double t) const; ///< g_ is the last change of the multipliers
  void              factorise(double t);
  void              move(Eigen::VectorXd &x, Eigen::VectorXd &xi, double t);
  bool              is_small(const Eigen::VectorXd &p);
  void              set_load(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v);
  void              tabulate();
  void   follow(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ConstraintJacobian &G, LocalState &local);
  bool   follow_sparse(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ImplicitStep &step, LocalState &local,
                       IntegrationWork &work);
  void   find_terms(const ConstraintJacobian &G, const LocalState &local);
  bool   close_sparse(const SaddleMatrix &K, const ConstraintJacobian &G, LocalState &local, IntegrationWork &work);
  void   iterate(LocalState &local, IntegrationWork &work);
  void   prepare_hold(double t);
  void   condense();
  void   find_compliance();
  void   iterate_sparse(Eigen::VectorXd &a, LocalState &local, IntegrationWork &work);
  void   factorise_sparse(double t);
  void   move_sparse(Eigen::VectorXd &x, Eigen::VectorXd &xi, double t);
  double largest_acceleration(const Eigen::VectorXd &p);

  const SecondOrderSystem                 &system_;
  std::unique_ptr<LinearSolver>            mass_;
  std::shared_ptr<const LoadedCoordinates> loaded_;
  Eigen::MatrixXd                          Y_; ///< M^-1 of the loaded coordinates [n x n_N]
  Compliance                               D_;
  Eigen::VectorXd                          f_, product_, a_free_, correction_, scale_;
  ConstraintJacobian                       G_;
  Eigen::VectorXd                          g_, rate_, bias_; // [n_c]
  Eigen::VectorXd                          tangent_;         ///< dp/du'' by blocks
  std::unique_ptr<CondensedMatrix>         matrix_;          ///< null: sparse
  std::unique_ptr<SaddleMatrix>            saddle_;          ///< null: condensed
  Eigen::VectorXd                          y_, load_;        ///< [n + n_c + n_h], [n]
  bool                                     linear_ =
      true; ///< no force depends on u'' or multipliers, in the branches of the last solve(): tangent_ is zero
  Eigen::MatrixXd  Y_B_, Y_C_;                ///< Y^T B, Y^T C [n_N x n]; empty until needed
  Eigen::VectorXd  a_load_, moved_;           ///< [n_N] Y^T f_t, Y^T (f_t - B q' - C q)
  bool             load_known_ = false;       ///< a_load_ is, of a constant load
  Eigen::VectorXd  terms_;                    ///< [n_c] of g'' in close_sparse()
  Eigen::VectorXd  compliance_;               ///< [n_u] diagonal of D; empty: condensed
  bool             step_is_near_ = true;      ///< the step's factor has corrected multipliers so far
  std::vector<int> holding_;                  ///< measures for which hold_f_ to delassus_ are computed
  Eigen::MatrixXd  hold_f_, hold_v_, hold_q_; ///< M^-1 W_h, B M^-1 W_h, C M^-1 W_h [n x n_h]
  Eigen::MatrixXd  hold_D_;                   ///< rows D_h [n_h x n_u]
  Eigen::VectorXd  held_p_, a_;               ///< [n_h], [n]
  SmallLu          delassus_;                 ///< D_hh
};

} // namespace gestell::coupling
