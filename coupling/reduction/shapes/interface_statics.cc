#include "coupling/reduction/shapes/interface_statics.h"

#include "coupling/reduction/shapes/attachment_modes.h"
#include "coupling/reduction/shapes/interface_flexibility.h"

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

FixedInterfaceFrame factorised(const fem::FrameMatrices &frame, const ReductionOptions &options,
                               const Progress &progress, fem::FrameMatrices *given)
{
  if (progress)
    progress("factorisation", -1.);
  return {frame, frame.interface_coordinates(), options.factor, options.eigensolver, given};
}

MatrixXd acceleration_load(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame)
{
  if (frame.translations.rows() == 0)
    return MatrixXd(frame.M.rows(), 0);
  return frame.acceleration_load.rows() > 0 ? frame.acceleration_load : held.mass_times(frame.translations);
}

MatrixXd answers_of_forces(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame)
{
  const std::vector<std::size_t> which = force_outputs(frame.outputs);
  MatrixXd                       Y(frame.M.rows(), Eigen::Index(which.size()));
  for (std::size_t k = 0; k < which.size(); ++k)
    Y.col(Eigen::Index(k)) = frame.outputs[which[k]].on_q;
  if (Y.cols() > 0)
    held.solve_in_place(Y);
  return Y;
}

} // namespace

std::vector<std::size_t> force_outputs(const std::vector<fem::FrameOutput> &outputs)
{
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    if (outputs[k].unit == "N" || outputs[k].unit == "N m")
      which.push_back(k);
  return which;
}

ReductionBasis static_basis(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame)
{
  ReductionBasis basis;
  basis.q1    = frame.interface_coordinates();
  basis.T     = held.constraint_modes();
  basis.M_Psi = held.mass_times(basis.T);
  basis.C_11  = held.energy(basis.T);
  return basis;
}

InterfaceStatics::InterfaceStatics(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                   const Progress &progress, fem::FrameMatrices *given)
    : progress(progress), held(factorised(frame, options, progress, given))
{
  begin("constraint modes");
  basis    = static_basis(held, frame);
  load     = acceleration_load(held, frame);
  response = residual_flexibility(held, basis, load);
  forces   = answers_of_forces(held, frame);
  relief   = options.inertia_relief ? inertia_relief_shapes(held, frame, basis.q1) : MatrixXd(frame.M.rows(), 0);
  if (may_move_freely(basis.C_11))
    held.take_back(); // motions of the whole frame follow from its C
}

void InterfaceStatics::begin(const char *phase, double share) const
{
  if (progress)
    progress(phase, share);
}

} // namespace gestell::coupling
