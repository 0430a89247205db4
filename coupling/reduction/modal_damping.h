#pragma once

#include "coupling/frame/reduction_options.h"
#include "fem/values/frame_matrices.h"

#include <string>

namespace gestell::coupling
{

/// Fills frame.modal_damping with the lowest n_modes modes of the supported frame (rigid motions are not damped):
/// Z = M Phi, d = 2 zeta omega with zeta = frame.modal_damping_ratio.  Completeness is verified by inertia for a
/// supported frame, see SturmCheckedModes; for a floating one the elastic modes are used.
/// @param factor  see make_factor(); a floating frame has the one of "gestell".
/// @throws std::invalid_argument if the frame has fewer coordinates; ConvergenceFailure.
void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress = {},
                       const std::string &factor = "");

} // namespace gestell::coupling
