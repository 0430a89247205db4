#include "coupling/reduction/shapes/interface_statics.h"

#include "coupling/reduction/shapes/attachment_modes.h"

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

FixedInterfaceFrame factorised(const fem::FrameMatrices &frame, const ReductionOptions &options,
                               const Progress &progress)
{
  if (progress)
    progress("factorisation", -1.);
  return {frame, frame.interface_coordinates(), options.factor, options.eigensolver};
}

MatrixXd acceleration_load(const fem::FrameMatrices &frame)
{
  if (frame.translations.rows() == 0)
    return MatrixXd(frame.M.rows(), 0);
  return frame.acceleration_load.rows() > 0 ? frame.acceleration_load : symmetric_product(frame.M, frame.translations);
}

} // namespace

ReductionBasis static_basis(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame)
{
  ReductionBasis basis;
  basis.q1 = frame.interface_coordinates();
  basis.T  = held.constraint_modes();
  symmetric_product(frame.M, basis.T, basis.M_Psi);
  return basis;
}

InterfaceStatics::InterfaceStatics(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                   const Progress &progress)
    : progress(progress), held(factorised(frame, options, progress))
{
  begin("constraint modes");
  basis    = static_basis(held, frame);
  load     = acceleration_load(frame);
  response = residual_flexibility(held, basis, frame.M, load);
  relief   = options.inertia_relief ? inertia_relief_shapes(held, frame, basis.q1) : MatrixXd(frame.M.rows(), 0);
}

void InterfaceStatics::begin(const char *phase, double share) const
{
  if (progress)
    progress(phase, share);
}

} // namespace gestell::coupling
