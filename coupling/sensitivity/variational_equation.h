#pragma once

#include "coupling/sensitivity/motion_linearisation.h"

#include <map>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/// Derivatives of a motion by K parameters at a fixed time.
struct MotionColumns
{
  Eigen::MatrixXd q, v, a;          // [n x K]
  Eigen::MatrixXd u, u_rate, u_acc; // [n_u x K]
  Eigen::MatrixXd p;                // [n_u x K]
  Eigen::MatrixXd lambda;           // [n_c x K]
};

/**
 * The variational equations of a machine along a motion, s = dq/dx for K parameters x:
 *
 *     M s'' + B s' + C s = r + W dp,   dp = p_x + P_u W^T s + P_v W^T s' + P_a W^T s'' + G^T dlambda,
 *     r = -(M_x q'' + B_x q' + C_x q) + f_x + W_x p,
 *     G W^T s'' + Gamma_u W^T s + Gamma_v W^T s' + gamma_x = 0          ideal joints, index 1
 *     (W^T s'')_h = 0                                                   measures h that stick, dp_h unknown.
 *
 * with the terms of MotionLinearisation.
 *
 * A stage of an implicit method, s = s_0 + c s', s' = s'_0 + c s'', is solved like a step of an integrator, with A = M
 * + c B + c^2 C, condensed to the measures if these are fewer than the coordinates; c = 0 gives the accelerations for s
 * and s'.
 *
 * Source: docs/theory/sensitivities.md (2) to (5).
 */
class VariationalEquation
{
public:
  /// @throws std::invalid_argument as MotionLinearisation does
  VariationalEquation(Machine &machine, const std::vector<ParameterTwins> &twins);

  Machine                &machine() { return machine_; }
  MotionLinearisation    &linearisation() { return linearisation_; }
  int                     n_parameters() const { return n_parameters_; }
  const Eigen::VectorXd  &mass_diagonal() const { return mass_; }
  const std::vector<int> &lags() const { return lags_; }

  /// Projects s and s' (mass-weighted least change) so that joints remain closed,
  ///
  ///     G W^T s + g_x = 0,   G W^T s' + (G u' + rate)_u W^T s + (G u' + rate)_x = 0,
  ///
  /// because steps satisfy only the second derivative; then updates all members that follow from s and s'.
  void close_joints(const Linearised &at, MotionColumns &columns);
  /// Solves the stage for columns.q = s_0, columns.v = s'_0; fills all of `columns`.
  void solve(const Linearised &at, double c, MotionColumns &columns);

private:
  struct Base
  {
    std::unique_ptr<LinearSolver> solver;
    Eigen::MatrixXd               inverse, B, C; ///< A^-1, A^-1 B, A^-1 C of small systems, else empty
    Eigen::MatrixXd               Y, S;          ///< A^-1 W, W^T A^-1 W
  };

  const Base &base(double c);
  void        solve_base(const Base &base, const Eigen::MatrixXd &F, Eigen::MatrixXd &X) const;
  void        find_loads(const Linearised &at, const MotionColumns &columns);
  void        answer_loads(const Base &base, const Linearised &at, MotionColumns &columns);
  void        solve_condensed(const Base &base, const Linearised &at, double c, MotionColumns &columns);
  void        solve_whole(const Linearised &at, double c, MotionColumns &columns);
  void        find_forces(const Linearised &at, MotionColumns &columns) const;

  Eigen::MatrixXd joint_rows(const Linearised &at, double c) const;
  Eigen::MatrixXd joint_right(const Linearised &at, const MotionColumns &columns) const;

  void move(const Linearised &at, const Eigen::MatrixXd &open, Eigen::MatrixXd &s, Eigen::MatrixXd &of_measures);
  void settle_lags(const Linearised &at, MotionColumns &columns) const;

  Machine               &machine_;
  MotionLinearisation    linearisation_;
  int                    n_parameters_;
  std::map<double, Base> bases_;
  Eigen::MatrixXd        M_, B_, C_; ///< of small systems, else empty
  Eigen::VectorXd        mass_;
  std::vector<int>       lags_;           ///< coordinates without mass, ascending
  std::vector<double>    time_constants_; ///< [s] of them
  Eigen::MatrixXd        F_, X_, K_, k_, matrix_, right_, S_G_;
  Eigen::VectorXd        product_;
};

} // namespace gestell::coupling
