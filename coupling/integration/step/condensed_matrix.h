#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/small_lu.h"

#include <vector>

namespace gestell::coupling
{

/**
 * Newton's matrix condensed to the measures, bordered by the equations of ideal joints:
 *
 *     delta - S (p' delta + G^T dlambda) = r,     G delta = -g,
 *
 * S [n_u x n_u] symmetric.  p' acts on the measures F of force elements alone, G on those of joints, and no measure is
 * both.  So little is left to factorise, the forces and then the joints:
 *
 *     delta_F = J^-1 (r_F + P^T dlambda),       J = E - S_FF p'       [n_F x n_F],     P = G S_JF,
 *     H dlambda = -g - G r_J - P p' J^-1 r_F,   H = G S_JJ G^T + P p' J^-1 P^T         [n_c x n_c],
 *     delta = r + S_:F p' delta_F + S G^T dlambda.
 *
 * S G^T and G S G^T, most of the work, are kept until set_joints() is called again.  Of a measure that is held delta is
 * the change of its force; while it is sought, S_hh times that: S_hh goes with h^2, and beside p' = d/h of a damper a
 * force in its own unit would be taken for rounding in short steps.  Nothing allocates after construction.
 */
class CondensedMatrix
{
public:
  explicit CondensedMatrix(const SecondOrderSystem &system);

  /// To be called before factorise() where there are joints, and again where G has turned too far.
  void set_joints(const Eigen::MatrixXd &S, const ConstraintJacobian &G);

  /// @param tangent  p' as local_tangent_blocks() gives it
  /// @return false: singular, see the joints by failed_joint(), or the forces where that is -1
  bool factorise(const Eigen::MatrixXd &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held);

  /// r [n_u] becomes delta, g [n_c] becomes dlambda.
  void solve_in_place(const Eigen::MatrixXd &S, const ConstraintJacobian &G, Eigen::VectorXd &r, Eigen::VectorXd &g);

  /// The equation that depends on those before it.
  int failed_joint() const { return failed_joint_; }

private:
  /// An entry of p' that is not zero, by positions in F; of a held measure 1/S_hh, so that p' delta is its force.
  struct Entry
  {
    int    row, column;
    double value;
  };

  void collect(const Eigen::MatrixXd &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held);
  void times_tangent(const double *x, double *y) const;

  std::vector<ForceBlock> blocks_;
  std::vector<int>        of_forces_; ///< F: the measures of all blocks, one behind the other
  std::vector<char>       is_held_;   ///< [n_F]
  std::vector<Entry>      tangent_;
  SmallLu                 forces_;        ///< J
  Eigen::MatrixXd         S_G_;           ///< S G^T [n_u x n_c]
  Eigen::MatrixXd         G_S_G_;         ///< G S G^T [n_c x n_c]
  Eigen::MatrixXd         X_;             ///< J^-1 P^T [n_F x n_c]
  SmallLu                 joints_;        ///< H
  Eigen::VectorXd         delta_F_, p_F_; ///< [n_F]
  int                     failed_joint_ = -1;
};

} // namespace gestell::coupling
