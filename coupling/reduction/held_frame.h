#pragma once

#include "coupling/reduction/lowest_modes.h"
#include "coupling/sparse_cholesky.h"
#include "fem/frame_matrices.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace gestell::fem
{
class RowsOnRanks;
}

namespace gestell::coupling
{

class TeamHeldFrame;

/**
 * The frame with its interface held: the one factor of C22 that constraint modes, fixed-interface modes, static
 * residual and damping refinement share.  Vectors have all n rows; those of q1 are held at zero.
 *
 * Where mpirun started several ranks the factor lies on all of them, and they find the modes together.
 */
class HeldFrame
{
public:
  /// @param rows of C and M if several ranks have them already; they are dealt out otherwise.
  /// @throws std::invalid_argument if C22 is singular, naming the motion that is free.
  HeldFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1, const fem::RowsOnRanks *rows = nullptr);
  ~HeldFrame();

  /// X <- C22^-1 X on the rows of q2, zero on those of q1.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const;

  /// [n x n1]: E on the rows of q1, -C22^-1 C21 on those of q2.
  Eigen::MatrixXd constraint_modes() const;

  /// The lowest modes of (C22 - omega^2 M22) v = 0 beyond those known, see lowest_modes().
  LowestModes lowest_modes(int count, const Eigen::Ref<const Eigen::MatrixXd> &known) const;

private:
  const fem::FrameMatrices       &frame_;
  std::vector<int>                q1_;
  std::unique_ptr<TeamHeldFrame>  team_;   // either this
  std::unique_ptr<SparseCholesky> factor_; // or that
};

} // namespace gestell::coupling
