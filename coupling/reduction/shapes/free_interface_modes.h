#pragma once

#include "coupling/eigensolvers/sturm_check.h"
#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace gestell::coupling
{

/**
 * C^+ of the frame with its interface free, for balanced loads, from the factor of C22 by block elimination
 * (reduction.md (15)):
 *
 *     x = (0; C22^-1 f2) + Psi S^+ Psi^T f,     x^T M R = 0,     S = C*_11.
 */
class FreeInverse
{
public:
  /// @param basis  constraint modes only.  It and the fixed-interface frame must outlive this.
  FreeInverse(const FixedInterfaceFrame &held, const ReductionBasis &basis, const fem::FrameMatrices &frame);

  const Eigen::MatrixXd &rigid() const { return R_; } ///< motions R [n x k], R^T M R = E

  /// X <- C^+ X.
  void operator()(Eigen::Ref<Eigen::MatrixXd> X) const;

private:
  const FixedInterfaceFrame &held_;
  const Eigen::MatrixXd     &Psi_;
  Eigen::MatrixXd            S_inverse_, R_, MR_;
};

/// The elastic modes of the supported frame with free interface; those of a floating one are M-orthogonal to its
/// rigid motions.
class FreeInterfaceModes final : public SturmCheckedModes
{
public:
  /// @param basis  constraint modes only.  All three must outlive this.
  FreeInterfaceModes(FixedInterfaceFrame &held, const ReductionBasis &basis, const fem::FrameMatrices &frame,
                     const BlockLanczos::Options &options = {});

  int n_rigid() const { return int(inverse_.rigid().cols()); }

private:
  int                         n() const override;
  LowestModes                 all() const override;
  void                        restore() override { held_.restore(); }
  void                        release() override { held_.release(); }
  Inertia                     below(double omega) override;
  std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const override;

  FixedInterfaceFrame      &held_;
  const fem::FrameMatrices &frame_;
  FreeInverse               inverse_;
};

/// Modes of the supported frame with free interface.
struct FreeModes
{
  Eigen::VectorXd omega;     // [k] elastic, ascending [rad/s]
  Eigen::MatrixXd W;         // [n x k] modes less their static part, phi - Psi phi_1: zero on q1
  std::string     statement; // verification of completeness; empty if not needed
  int             n_rigid = 0;
};

/**
 * The lowest elastic modes with the interface free, counted by inertia like fixed-interface modes. With the constraint
 * modes their shapes span the space of MacNeal and Rubin: rigid-body modes, residual flexibility of every interface
 * DOF, and the modes themselves, whose frequencies are exact in the reduced model.
 *
 * @param held     its factor is released: restore() it to solve again.
 * @param basis    constraint modes only.
 * @param options  n_modes; < 0: all up to 1.5 times the highest frequency of interest.
 * @throws ConvergenceFailure (eigenvalue solver, or modes that are missing and not found).
 */
FreeModes free_modes(const ReductionBasis &basis, FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                     const ReductionOptions &options);

} // namespace gestell::coupling
