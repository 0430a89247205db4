#pragma once

#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/virtual_rates.h"
#include "coupling/sensitivity/parameter_twins.h"

#include <vector>

namespace gestell::coupling
{

/// Rejects a machine without variational equations before its run.
/// @throws std::invalid_argument with the reason and the remedy
void require_variational(const Machine &machine);

/// The motion and its accelerations, forces and multipliers from the equation of motion.
struct MotionState
{
  double          t = 0.;
  Eigen::VectorXd q, v, a; // [n]
  LocalState      local;
};

/// The equations of motion linearised at a motion, and their changes by parameters at fixed motion.
struct Linearised
{
  Eigen::MatrixXd    P_u, P_v, P_a; ///< dp/du, dp/du', dp/du'' [n_u x n_u]; that of joints, d(G^T lambda)/du, is in P_u
  ConstraintJacobian G;
  Eigen::MatrixXd    Gamma_u, Gamma_v; ///< d(G u'' + bias)/du, /du' [n_c x n_u]
  Eigen::MatrixXd    G_rate;           ///< d(G u' + rate)/du [n_c x n_u]
  Eigen::MatrixXd    r;                ///< [n x K] loads by M, B, C, W and f_t of the parameters
  Eigen::MatrixXd    p;                ///< [n_u x K] forces by the parameters
  Eigen::MatrixXd    g, g_rate, gamma; ///< [n_c x K] of g, g' and g'' by the parameters
  Eigen::MatrixXd    u, v, a;          ///< [n_u x K] of W^T q, q', q'' due to W; empty: no parameter changes W
  Eigen::VectorXd r_t, p_t, gamma_t; ///< explicit time derivatives of r [n], p [n_u] and g'' [n_c]; zero: not requested
};

/**
 * Linearises a machine along a motion: exact derivatives of the laws (by quotients if their directions rotate), and
 * changes by parameters at fixed motion, by central quotients of the two machines of each parameter with their present
 * histories.
 *
 * Source: docs/theory/sensitivities.md (3), (4).
 */
class MotionLinearisation
{
public:
  /// @throws std::invalid_argument as require_variational() does, and for a massless coordinate that is not a
  ///   first-order state
  MotionLinearisation(Machine &machine, const std::vector<ParameterTwins> &twins);

  /// Computes accelerations, forces and multipliers of a motion, and the rates of massless coordinates; state.t, q, v
  /// are given, local.lambda is the initial guess.
  void complete(MotionState &state);
  /// Starts a smooth piece of the motion through these instants.  Parameters whose two machines have identical forces
  /// at all of them are skipped on it, as are force derivatives by u'' that are zero there, and time rates if these
  /// motions have the same forces at the first of these instants.  Without instants nothing is skipped.
  void begin_piece(const std::vector<MotionState> &passed);
  /// Linearises at a state, with the present histories of the machine and its twins.
  /// @param way  [s] short relative to the motion: also time derivatives; 0: none
  void linearise(const MotionState &state, Linearised &at, double way = 0.);

private:
  /// Derivatives of M, B, C, W by a parameter; empty: none.
  struct Changes
  {
    bool                        load   = false;
    bool                        forces = true, joints = true; ///< on the present piece
    Eigen::SparseMatrix<double> M, B, C, W;
  };

  /// g, g' = G u' + rate and g'' = G u'' + bias [n_c] at a motion.
  struct JointTerms
  {
    Eigen::VectorXd g, rate, acceleration;
  };

  void find_changes();
  void find_inexact(const MotionState &state);
  void differentiate(const MotionState &state, const std::vector<char> &marked, double by, Linearised &at);

  static double way(const ForceBlock &block, int measure, bool rates, const LocalState &local);

  void add_loads(const MotionState &state, int k, Linearised &at);
  void add_forces(const MotionState &state, int k, Linearised &at);
  void add_joints(const MotionState &state, Linearised &at);
  void clear_rates(const MotionState &state, Linearised &at) const;
  void add_at(double t, double factor, const MotionState &state, Linearised &at);
  void add_rates(const MotionState &state, double way, Linearised &at);
  void bend_joints(const MotionState &state, Eigen::VectorXd LocalState::*moved, Eigen::MatrixXd &Gamma,
                   Linearised *of_u);
  void joint_terms(const Machine &machine, const LocalState &local, JointTerms &terms, ConstraintJacobian &G);

  Machine                           &machine_;
  const std::vector<ParameterTwins> &twins_;
  ConsistentStart                    consistent_;
  VirtualRates                       virtual_rates_;
  IntegrationWork                    work_;
  std::vector<Changes>               changes_;
  Eigen::VectorXd                    minus_, plus_, product_, rate_, g_;
  ConstraintJacobian                 G_minus_, G_plus_;
  LocalState                         moved_;
  std::vector<ForceBlock>            blocks_;
  std::vector<char>                  inexact_; ///< blocks whose derivatives neglect the rotation of their directions
  bool                               of_accelerations_ = true; ///< a force depends on u'' on the present piece
  bool                               of_time_          = true; ///< there are explicit time derivatives on the piece
};

} // namespace gestell::coupling
