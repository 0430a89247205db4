#pragma once

#include "coupling/integration/step/consistent_start.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <map>
#include <memory>
#include <vector>

namespace gestell::coupling
{

/// Refuses a machine whose variational equations are not built, before it runs.
/// @throws std::invalid_argument with what it is and the way out
void require_variational(const Machine &machine);

/// The motion and its accelerations, forces and multipliers, as the equation of motion gives them.
struct MotionState
{
  double          t = 0.;
  Eigen::VectorXd q, v, a; // [n]
  LocalState      local;
};

/// Derivatives of a motion by K parameters at a fixed time.
struct MotionColumns
{
  Eigen::MatrixXd q, v, a;          // [n x K]
  Eigen::MatrixXd u, u_rate, u_acc; // [n_u x K]
  Eigen::MatrixXd p;                // [n_u x K]
  Eigen::MatrixXd lambda;           // [n_c x K]
};

/// The equations of motion linearised at a motion, and what parameters change in them while it is held fixed.
struct Linearised
{
  Eigen::MatrixXd    P_u, P_v, P_a; ///< dp/du, dp/du', dp/du'' [n_u x n_u]; that of joints, d(G^T lambda)/du, is in P_u
  ConstraintJacobian G;
  Eigen::MatrixXd    Gamma_u, Gamma_v; ///< d(G u'' + bias)/du, /du' [n_c x n_u]
  Eigen::MatrixXd    r;                ///< [n x K] loads by M, B, C, W and f_t of the parameters
  Eigen::MatrixXd    p;                ///< [n_u x K] forces by the parameters
  Eigen::MatrixXd    gamma;            ///< [n_c x K] of g'' by the parameters
  Eigen::MatrixXd    u, v, a;          ///< [n_u x K] of W^T q, q', q'' by W; empty: no parameter changes W
};

/**
 * The variational equations of a machine along a motion, s = dq/dx for K parameters x:
 *
 *     M s'' + B s' + C s = r + W dp,   dp = p_x + P_u W^T s + P_v W^T s' + P_a W^T s'' + G^T dlambda,
 *     r = -(M_x q'' + B_x q' + C_x q) + f_x + W_x p,
 *     G W^T s'' + Gamma_u W^T s + Gamma_v W^T s' + gamma_x = 0          ideal joints, index 1
 *     (W^T s'')_h = 0                                                   measures h that stick, dp_h unknown.
 *
 * P are the exact derivatives of the laws (of those that act along directions which turn, by quotients); what carries
 * the index x is the central quotient of two machines at a fixed motion and with the histories that each of them has by
 * then.
 *
 * A stage of an implicit method, s = s_0 + c s', s' = s'_0 + c s'', is solved as a step of an integrator is, with
 * A = M + c B + c^2 C condensed to the measures; c = 0 gives the accelerations that belong to s and s'.
 *
 * Source: docs/sensitivities.md (2) to (5).
 */
class VariationalEquation
{
public:
  /// @throws std::invalid_argument as require_variational(), and for a coordinate without mass that is no lag
  VariationalEquation(Machine &machine, const std::vector<ParameterTwins> &twins);

  Machine                &machine() { return machine_; }
  int                     n_parameters() const { return int(twins_.size()); }
  const Eigen::VectorXd  &mass_diagonal() const { return mass_; }
  const std::vector<int> &lags() const { return lags_; }

  /// Accelerations, forces and multipliers of a motion; state.t, q, v are given, local.lambda is where to begin.
  void complete(MotionState &state);
  /// A smooth piece of the motion begins, that passes these instants: parameters whose two machines have bit by bit
  /// equal forces at all of them are not looked at on it, nor are forces' dependences on u'' that are zero there.
  void begin_piece(const std::vector<MotionState> &passed);
  /// What there is at a state, by the histories that the machine and its twins have now.
  void linearise(const MotionState &state, Linearised &at);
  /// Of columns.q = s_0, columns.v = s'_0 the stage: all of `columns`.
  void solve(const Linearised &at, double c, MotionColumns &columns);

private:
  struct Base
  {
    std::unique_ptr<LinearSolver> solver;
    Eigen::MatrixXd               inverse; ///< of small systems, else empty
    Eigen::MatrixXd               Y, S;    ///< A^-1 W, W^T A^-1 W
  };
  /// What of the linear base a parameter changes.
  struct Changes
  {
    bool                        mass = false, damping = false, stiffness = false, load = false;
    bool                        forces = true, joints = true; ///< on the present piece
    Eigen::SparseMatrix<double> W;                            ///< dW/dx; empty: none
  };

  const Base &base(double c);
  void        solve_base(const Base &base, const Eigen::MatrixXd &F, Eigen::MatrixXd &X) const;
  void        find_changes();
  void        settle_lags(const Linearised &at, MotionColumns &columns) const;
  void        add_loads(const MotionState &state, int k, Linearised &at);
  void        add_forces(const MotionState &state, int k, Linearised &at);
  void        add_joints(const MotionState &state, Linearised &at);
  void        find_inexact(const MotionState &state);
  void        differentiate(const MotionState &state, const std::vector<char> &blocks, Linearised &at);
  void        bend_joints(const MotionState &state, Eigen::VectorXd LocalState::*moved, Eigen::MatrixXd &Gamma,
                          Eigen::MatrixXd *P);
  void joint_terms(const Machine &machine, const LocalState &local, Eigen::VectorXd &terms, ConstraintJacobian &G);

  Machine                           &machine_;
  const std::vector<ParameterTwins> &twins_;
  ConsistentStart                    consistent_;
  IntegrationWork                    work_;
  std::vector<Changes>               changes_;
  std::map<double, Base>             bases_;
  Eigen::MatrixXd                    B_, C_; ///< of small systems, else empty
  Eigen::VectorXd                    mass_;
  std::vector<int>                   lags_;           ///< coordinates without mass, ascending
  std::vector<double>                time_constants_; ///< [s] of them
  Eigen::MatrixXd                    F_, X_, K_, k_, matrix_, right_;
  Eigen::VectorXd                    minus_, plus_, product_, rate_, bias_, g_;
  ConstraintJacobian                 G_minus_, G_plus_;
  LocalState                         moved_;
  std::vector<ForceBlock>            blocks_;
  std::vector<char>                  inexact_; ///< blocks whose derivatives leave out how their directions turn
  bool                               of_accelerations_ = true; ///< a force depends on u'' on the present piece
};

} // namespace gestell::coupling
