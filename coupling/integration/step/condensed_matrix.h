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
 * S [n_u x n_u] symmetric.  p' acts only on the measures F of force elements, G only on those of joints, and no measure
 * is both.  Therefore two small matrices are factorised, that of the forces and then that of the joints:
 *
 *     delta_F = J^-1 (r_F + P^T dlambda),       J = E - S_FF p'       [n_F x n_F],     P = G S_JF,
 *     H dlambda = -g - G r_J - P p' J^-1 r_F,   H = G S_JJ G^T + P p' J^-1 P^T         [n_c x n_c],
 *     delta = r + S_:F p' delta_F + S G^T dlambda.
 *
 * S G^T and G S G^T, most of the work, are stored until set_joints() is called again.  For a sticking measure delta is
 * the change of its force; the unknown in the solution is S_hh times that, because S_hh is proportional to h^2:
 * compared with p' = d/h of a damper, a force in its own unit would be mistaken for rounding in short steps.  Nothing
 * allocates after construction.
 */
class CondensedMatrix
{
public:
  explicit CondensedMatrix(const SecondOrderSystem &system);

  /// To be called before factorise() if there are joints, and again if G has changed too much.
  void set_joints(const Eigen::MatrixXd &S, const ConstraintJacobian &G);

  /// @param tangent  p' as local_tangent_blocks() gives it
  /// @return false: singular because of the joint failed_joint(), or of the forces if that is -1
  bool factorise(const Eigen::MatrixXd &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held);

  /// r [n_u] becomes delta, g [n_c] becomes dlambda.
  void solve_in_place(const Eigen::MatrixXd &S, const ConstraintJacobian &G, Eigen::VectorXd &r, Eigen::VectorXd &g);

  /// The same without forces that depend on the motion: lambda from the g'' of lambda = 0; u'' becomes that with it.
  /// @param g  g'', becomes lambda
  void close_joints(Eigen::VectorXd &g, Eigen::VectorXd &a) const;

  /// The equation that depends on those before it.
  int failed_joint() const { return failed_joint_; }

private:
  /// A non-zero entry of p', by positions in F; for a sticking measure 1/S_hh, so that p' delta is its force.
  struct Entry
  {
    int    row, column;
    double value;
  };

  void collect(const Eigen::MatrixXd &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held);
  void times_tangent(const double *x, double *y) const;
  bool factorise_joints();

  std::vector<ForceBlock> blocks_;
  std::vector<int>        of_forces_; ///< F: the measures of all blocks, one after the other
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
