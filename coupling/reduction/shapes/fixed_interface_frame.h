#pragma once

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/block_lanczos.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

class TeamFactor;

/**
 * The frame with its interface fixed: the factor of C22 shared by constraint modes, fixed-interface modes, static
 * residual and damping refinement. Vectors have all n rows; those of q1 are zero. The factor dominates the memory;
 * release() frees it before modes are counted.
 *
 * Under mpirun the factor is distributed over all ranks, which compute the modes together: see DividedFactor.
 */
class FixedInterfaceFrame
{
public:
  /// @throws std::invalid_argument if C22 is singular, with the rigid-body mode.
  /// @param eigensolver  see search_modes().
  FixedInterfaceFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1,
                      std::string eigensolver = "block-lanczos");
  ~FixedInterfaceFrame();

  /// X <- C22^-1 X on the rows of q2, zero on those of q1.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const;

  /// [n x n1]: E on the rows of q1, -C22^-1 C21 on those of q2.
  Eigen::MatrixXd constraint_modes() const;

  /// Frees the memory of the factor; restore() computes it again if needed.
  void release();
  void restore();

  /// Number of fixed-interface modes below omega [rad/s], by the inertia of C22 - omega^2 M22; also after release().
  Inertia below(double omega) const;

  /// The same for the free interface, including rigid-body modes; analyses its own pattern in the first call.
  Inertia below_if_free(double omega);

  const std::string &eigensolver() const { return eigensolver_; }
  /// For fixed-interface modes; the frame must outlive it.
  std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const;

private:
  std::unique_ptr<TeamFactor> on_ranks(const std::vector<int> &q1) const;
  void                        factorise();

  const fem::FrameMatrices       &frame_;
  std::vector<int>                q1_;
  std::string                     eigensolver_;
  std::unique_ptr<TeamFactor>     team_, free_team_;     // either these
  std::unique_ptr<SparseCholesky> factor_, free_factor_; // or those
};

} // namespace gestell::coupling
