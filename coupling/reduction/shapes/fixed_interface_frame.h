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
  /// @param given        the same frame, if M and C may be without entries until take_back(): several ranks store them.
  FixedInterfaceFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1, std::string factor = "",
                      std::string eigensolver = "block-lanczos", fem::FrameMatrices *given = nullptr);

  /// X <- C22^-1 X on the rows of q2, zero on those of q1.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const { factor_->solve_in_place(X); }

  /// [n x n1]: E on the rows of q1, -C22^-1 C21 on those of q2.
  Eigen::MatrixXd constraint_modes() const;

  Eigen::MatrixXd mass_times(const Eigen::Ref<const Eigen::MatrixXd> &X) const { return product(Given::M, X); }
  Eigen::MatrixXd stiffness_times(const Eigen::Ref<const Eigen::MatrixXd> &X) const { return product(Given::C, X); }
  /// Psi^T C Psi [n1 x n1], C Psi summed in twice the working precision.
  Eigen::MatrixXd energy(const Eigen::MatrixXd &Psi) const;
  Eigen::VectorXd mass_diagonal() const { return at(Given::M).diagonal; }
  Eigen::VectorXd stiffness_diagonal() const { return at(Given::C).diagonal; }
  /// Fills the given frame again.
  void take_back() const;

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
  /// What rank 0 keeps of a matrix.
  struct Kept
  {
    Eigen::SparseMatrix<double> columns;  // of q1 [n x n1]
    Eigen::VectorXd             diagonal; // [n]
  };
  const Kept     &at(Given which) const { return which == Given::C ? C_ : M_; }
  Eigen::MatrixXd product(Given which, const Eigen::Ref<const Eigen::MatrixXd> &X) const;

  const fem::FrameMatrices        &frame_;
  fem::FrameMatrices              *given_;
  Kept                             C_, M_;
  std::vector<int>                 q1_;
  std::string                      factor_name_, eigensolver_;
  std::unique_ptr<StiffnessFactor> factor_, free_factor_;
};

} // namespace gestell::coupling
