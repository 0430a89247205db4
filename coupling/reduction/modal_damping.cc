#include "coupling/reduction/modal_damping.h"

#include "coupling/eigensolvers/sparse_modes.h"
#include "coupling/reduction/mode_ratios.h"
#include "coupling/reduction/shapes/fixed_interface_modes.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/assembly/rigid_motions.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

/// Of the modes V [n x p] of a frame, ascending; outputs with inertia receive it as well.
fem::ModalDamping modal_operator(fem::FrameMatrices &frame, const Eigen::MatrixXd &V, const Eigen::VectorXd &omega)
{
  ModesAtPoints modes{omega, frame.picture.points};
  if (frame.picture.displacement.rows() > 0)
    modes.shapes = frame.picture.displacement * V;
  fem::ModalDamping damping{symmetric_product(frame.M, V),
                            modal_dampers(matched(frame.modal_damping_ratio, modes, frame.statements), omega,
                                          V.transpose() * symmetric_product(frame.B, V))};
  for (fem::FrameOutput &output : frame.outputs) // like inertia, these forces act on masses
    if (output.on_a.size() > 0)
      output.on_v += damping.Z * damping.d.cwiseProduct(V.transpose() * output.on_a);
  return damping;
}

} // namespace

void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress, const std::string &factor)
{
  const int n = int(frame.M.rows());
  if (n_modes < 0 || n_modes > n)
    throw std::invalid_argument("add_modal_damping: " + std::to_string(n_modes) + " modes requested for a frame with " +
                                std::to_string(n) + " DOFs; request 0 to " + std::to_string(n));
  if (const int n_free = int(fem::free_motions(frame, {}).size()); n_free > 0)
  {
    if (progress)
      progress("modes of the floating frame", -1.);
    const DenseModes modes   = sparse_modes(frame.C, frame.M, std::min(n, n_modes + n_free));
    const auto       elastic = std::min<Eigen::Index>(n_modes, modes.omega.size() - n_free);
    frame.modal_damping      = modal_operator(frame, modes.V.rightCols(elastic), modes.omega.tail(elastic));
    return;
  }
  if (progress)
    progress("factorisation", -1.);
  FixedInterfaceFrame free_frame(frame, {}, factor);
  if (progress)
    progress("modes of the supported frame", -1.);
  FixedInterfaceModes fixed(free_frame, frame, {});
  const LowestModes   modes = fixed.find_all(n_modes);
  frame.modal_damping       = modal_operator(frame, modes.V, modes.omega);
}

} // namespace gestell::coupling
