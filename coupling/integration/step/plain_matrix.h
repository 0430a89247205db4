#pragma once

#include "coupling/integration/step/compliance.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/small_lu.h"

#include <vector>

namespace gestell::coupling
{

/**
 * Newton's matrix of few measures without joints:  delta - S p' delta = r.
 *
 * The unknowns y are the measures on which forces depend, and the forces of those that stick, in displacements (see
 * CondensedMatrix).  With the columns B of p' for them:  J y = r_y,  J = E - (S B)_y;  the others follow from
 * delta = r + S B y.
 */
class PlainMatrix
{
public:
  PlainMatrix(const std::vector<ForceBlock> &blocks, int n_u);

  /// @param S  [n_u x n_u]
  /// @param tangent  p' as local_tangent_blocks() gives it
  /// @return false: singular
  bool factorise(const Eigen::MatrixXd &S, const double *tangent, const std::vector<HeldMeasure> &held);
  /// r [n_u] becomes delta, for a sticking measure the change of its force.
  void solve_in_place(Eigen::VectorXd &r);
  /// Unknowns of the last factorisation.
  int size() const { return int(seen_.size()); }

private:
  struct Seen
  {
    int    measure;
    double force; ///< of a sticking measure by displacement; 0: it moves
  };

  std::vector<ForceBlock> blocks_;
  std::vector<Seen>       seen_;
  Eigen::MatrixXd         S_B_; ///< [n_u x n_y]
  SmallLu                 J_;
  Eigen::VectorXd         y_;
};

} // namespace gestell::coupling
