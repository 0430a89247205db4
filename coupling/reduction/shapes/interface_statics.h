#pragma once

#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "coupling/reduction/shapes/residual_flexibility.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// T without modes.
ReductionBasis static_basis(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame);

/// Positions of the forces and moments among the outputs of a frame: sections and supports, but no stresses.
std::vector<std::size_t> force_outputs(const std::vector<fem::FrameOutput> &outputs);

/// Common start of every reduction: the factor of C22, the constraint modes, and deflections independent of modes.
struct InterfaceStatics
{
  /// The frame must outlive it; `given`: see FixedInterfaceFrame.
  /// @throws std::invalid_argument if a rigid-body mode remains with the interface fixed.
  InterfaceStatics(const fem::FrameMatrices &frame, const ReductionOptions &options, const Progress &progress,
                   fem::FrameMatrices *given = nullptr);

  void begin(const char *phase, double share = -1.) const; ///< reports a phase to `progress`

  Progress            progress;
  FixedInterfaceFrame held;
  ReductionBasis      basis;    ///< constraint modes only
  Eigen::MatrixXd     load;     ///< [n x 3] of a unit acceleration in x, y, z, or [n x 0]
  ResidualFlexibility response; ///< to the inertia of constraint modes, and to the load
  Eigen::MatrixXd     forces;   ///< [n x k] C22^-1 of the rows on q of force_outputs()
  Eigen::MatrixXd     relief;   ///< shapes [n x 6, 3 or 0], see inertia_relief_shapes()
};

} // namespace gestell::coupling
