#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/small_lu.h"
#include "coupling/integration/system/time_integrator.h"

#include <Eigen/LU>

#include <memory>

namespace gestell::peers
{

/**
 * A SecondOrderSystem as y' = F(t, y), y = (q, v) [2 n], for libraries for such systems, with its Jacobian and a solver
 * for its Newton matrix that exploits the structure.
 *
 *     q' = v,     v' = M^-1 (f_t + W p - B v - C q)
 *
 * Sticking measures have u'' = 0 with p_h = -(W_h^T M^-1 W_h)^-1 W_h^T M^-1 (all other forces).
 *
 * The libraries work on plain arrays: y, y', b are arrays of 2 n numbers.
 */
class FirstOrderForm
{
public:
  /// @throws std::invalid_argument if M is singular or the system has constraints
  explicit FirstOrderForm(const coupling::SecondOrderSystem &system);

  int size() const { return 2 * n_; }

  /// y' = F(t, y).
  void rate(double t, const double *y, double *y_rate);

  /// r = (q' - v, M v' + B v + C q - f_t - W p).
  void residual(double t, const double *y, const double *y_rate, double *r);

  /// Measures and their forces at (t, y).
  void local_state(double t, const double *y, coupling::LocalState &local);

  /// dp/du, dp/dv at (t, y), used by the following functions.
  void linearise(double t, const double *y);

  /// Prepares solving with the Newton matrix for a leading coefficient gamma [s]:
  ///     A = M + gamma B + gamma^2 C - W (gamma dp/dv + gamma^2 dp/du) W^T
  /// @return false if A is singular
  bool factorise(double gamma);

  /// Like factorise(), for  w_M M + w_B B + C - W (w_B dp/dv + dp/du) W^T: a formula only in the displacements.
  bool factorise_displacements(double w_M, double w_B);

  /// b [n] := (this matrix)^-1 b.
  void solve_displacements(double *b);

  /// r [n] = M v' + B v + C q - f_t - W p.
  void displacement_residual(double t, const double *y, const double *acceleration, double *r);

  /// b := (I - gamma dF/dy)^-1 b.
  void solve_rate_form(double *b);

  /// b := (dr/dy + 1/gamma dr/dy')^-1 b.
  void solve_residual_form(double *b);

  /// Prepares the dense Jacobians below.
  /// @throws std::invalid_argument for a system too large for dense matrices
  void know_dense();

  /// dF/dy [2 n x 2 n].
  void rate_jacobian(Eigen::Ref<Eigen::MatrixXd> J);

  /// dr/dy + dr/dy' / gamma [2 n x 2 n].
  /// @return false: unknown while measures stick
  bool residual_jacobian(double gamma, Eigen::Ref<Eigen::MatrixXd> J);

  /// Forces, factorisations and solves so far.
  const coupling::IntegrationWork &work() const { return work_; }

private:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  bool prepare(double w_M, double w_B, double w_C, double tangent_v, double tangent_u);
  void load(double t, const double *y);
  void add_held_forces();
  void solve_velocity();

  const coupling::SecondOrderSystem &system_;
  int                                n_, n_u_;

  std::unique_ptr<coupling::LinearSolver> mass_, shifted_;
  Matrix                                  Y_M_, S_M_; // M^-1 W [n x n_u], W^T M^-1 W

  double                    gamma_ = 0., known_M_ = 0., known_B_ = 0., known_C_ = 0.; ///< of shifted_
  Matrix                    Y_, S_, dp_du_, dp_dv_, tangent_;
  coupling::SmallLu         small_;
  coupling::LocalState      local_;
  Vector                    q_, v_, f_, a_, product_, column_, xi_, z_, held_rate_;
  coupling::IntegrationWork work_;

  bool   dense_known_ = false; // base matrices for the Jacobians
  Matrix M_, B_, C_, M_inv_B_, M_inv_C_;
};

} // namespace gestell::peers
