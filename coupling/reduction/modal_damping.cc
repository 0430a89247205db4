#include "coupling/reduction/modal_damping.h"

#include "coupling/reduction/shapes/fixed_interface_modes.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/assembly/rigid_motions.h"

#include <stdexcept>
#include <string>

namespace gestell::coupling
{

void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress)
{
  const int n = int(frame.M.rows());
  if (n_modes < 0 || n_modes > n)
    throw std::invalid_argument("add_modal_damping: " + std::to_string(n_modes) + " modes requested of a frame with " +
                                std::to_string(n) + " coordinates; ask for 0 to " + std::to_string(n));
  if (const auto motions = fem::free_motions(frame, {}); !motions.empty())
    throw std::invalid_argument(
        "modal damping: the frame floats (" + std::to_string(motions.size()) + " motions are free, one of them " +
        motions[0] +
        "), and an unreduced frame is damped by the modes of a supported one; support it, reduce it "
        "(reduction.method = \"craig-bampton\"), or damp it by rayleigh");
  if (progress)
    progress("factorisation", -1.);
  FixedInterfaceFrame free_frame(frame, {});
  if (progress)
    progress("modes of the supported frame", -1.);
  FixedInterfaceModes fixed(free_frame, frame, {});
  const LowestModes   modes = fixed.find_all(n_modes);
  frame.modal_damping.Z     = symmetric_product(frame.M, modes.V);
  frame.modal_damping.d     = frame.modal_damping_ratio.modal_dampers(modes.omega);
}

} // namespace gestell::coupling
