#pragma once

#include "coupling/reduction/estimates/interface_receptance.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Static internal shapes under internal dampers.
struct DamperAttachmentModes
{
  Eigen::MatrixXd W;         ///< [n x k], zero on q1
  double          left = 0.; ///< estimated relative error of the damped receptance with them, including truncated modes
  std::vector<double> of_groups{};       ///< the same for each interface separately
  bool                exhausted = false; ///< no remaining shape has mass: no DOF of the model could represent the rest
};

/// Whether B acts on DOFs outside q1.
bool has_inner_dampers(const ReductionBasis &basis, const Eigen::SparseMatrix<double> &B);

/// A model of fixed-interface modes and shapes.
struct ModelOfModes
{
  const ReductionBasis  &basis;   ///< with all known modes
  double                 highest; ///< omega_0 [rad/s] of the last mode, above all frequencies; INFINITY: all are known
  int                    m;       ///< number of modes in the model, the first ones
  const Eigen::MatrixXd &X;       ///< its shapes [n x k], zero on q1, or [n x 0]
};

/// Required accuracy of a receptance.
struct ReceptanceGoal
{
  std::vector<ReceptanceFrequency> frequencies; ///< as for InterfaceReceptance
  Groups                           groups;      ///< of q1, whose errors are reported separately
  double                           tolerance;
  int                              most; ///< shapes
};

/**
 * Completes a model by the missing deflection under internal dampers of the frame, such as those of its foundation.
 *
 * At the frequency omega let U = T p be the displacements of the model for unit displacements E of the interface.  With
 * Z = (1 + 2 i zeta) C - omega^2 M + i omega B they have the residual forces  r = (Z U)_2, and the dynamic stiffness of
 * the full frame is smaller than that of the model by
 *
 *     r^T Z22^-1 r,    Z22^-1 ~ sum_j v_j v_j^T / ((1 + 2 i zeta) omega_0j^2 - omega^2)
 *                               + (C22^-1 - sum_j v_j v_j^T / omega_0j^2) / ((1 + 2 i zeta) (1 - omega^2 / omega_0^2))
 *
 * with the known modes j and omega_0 a lower bound of the others. This is an upper bound for the inertia of the unknown
 * modes; dampers in Z22, which would reduce it, are neglected. It includes the errors of truncated modes and of
 * dampers. At the frequency with the largest resulting error of the receptance, principal directions of C22^-1 r are
 * added as shapes; this is repeated until the error is within the tolerance or `most` shapes are reached. Therefore
 * dampers may be arbitrarily strong: shapes of second order, C22^-1 B C22^-1 B Psi, are added in the second round.
 *
 * @param held  with its factor.
 * Source: docs/theory/reduction.md (16e).
 */
DamperAttachmentModes damper_attachment_modes(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                                              const ModelOfModes &modes, const ReceptanceGoal &goal);

} // namespace gestell::coupling
