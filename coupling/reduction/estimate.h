#pragma once

#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/methods/reduction_space.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// Error estimate of a reduced model.
struct ReductionEstimate
{
  FrequencyEstimate frequencies; ///< of the model, and their errors
  double            limit;       ///< [rad/s] up to which the model should be valid
};

/**
 * Error of the frequencies from the modes of the frame that the method knows, refined or exact.
 *
 * @param star  matrices of the whole basis.
 */
ReductionEstimate estimate(const ReductionSpace &space, const ReducedMatrices &star, const ReductionOptions &options);

/// Part of the static deflection of q2 under loads f [n x k] that the modes miss:  C22^-1 f2 - V22 diag(1/omega_0^2)
/// V22^T f2.
struct StaticRemainder
{
  Eigen::MatrixXd deflection;    ///< [n x k], zero in q1
  double          relative = 0.; ///< of the energy norm of C22^-1 f2; the worst load
};

/// @param deflection C22^-1 f2.
StaticRemainder static_remainder(const Eigen::MatrixXd &deflection, const ReductionBasis &basis,
                                 const Eigen::MatrixXd &load);

} // namespace gestell::coupling
