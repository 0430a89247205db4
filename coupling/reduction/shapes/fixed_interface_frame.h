#pragma once

#include "coupling/factors/stiffness_factor.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * The frame with its interface fixed: the factor of C22 shared by constraint modes, fixed-interface modes, static
 * residual and damping refinement. Vectors have all n rows; those of q1 are zero. The factor dominates the memory;
 * release() frees it before modes are counted.
 *
 * Under mpirun the factor is distributed over all ranks, which compute the modes together: see StiffnessFactor.
 */
class FixedInterfaceFrame
{
public:
  /// @throws std::invalid_argument if C22 is singular, with the rigid-body mode.
  /// @param factor       see make_factor().
  /// @param eigensolver  see search_modes().
  FixedInterfaceFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1, std::string factor = "",
                      std::string eigensolver = "block-lanczos");

  /// X <- C22^-1 X on the rows of q2, zero on those of q1.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const { factor_->solve_in_place(X); }

  /// [n x n1]: E on the rows of q1, -C22^-1 C21 on those of q2.
  Eigen::MatrixXd constraint_modes() const;

  /// Frees the memory of the factor; restore() computes it again if needed.
  void release() { factor_->release(); }
  void restore() { factor_->factorise(); }

  /// Number of fixed-interface modes below omega [rad/s], by the inertia of C22 - omega^2 M22; also after release().
  Inertia below(double omega) const { return factor_->below(omega); }

  /// The same for the free interface, including rigid-body modes; analyses its own pattern in the first call.
  Inertia below_if_free(double omega);

  const std::string &eigensolver() const { return eigensolver_; }
  /// For fixed-interface modes; the frame must outlive it.
  std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const
  {
    return factor_->search(eigensolver_, options, known);
  }

private:
  std::unique_ptr<StiffnessFactor> factor_of(const std::vector<int> &held) const;

  const fem::FrameMatrices        &frame_;
  std::vector<int>                 q1_;
  std::string                      factor_name_, eigensolver_;
  std::unique_ptr<StiffnessFactor> factor_, free_factor_;
};

} // namespace gestell::coupling
