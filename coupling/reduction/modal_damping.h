#pragma once

#include "coupling/frame/reduction_options.h"
#include "fem/values/frame_matrices.h"

namespace gestell::coupling
{

/// Fills frame.modal_damping with the lowest n_modes modes of the supported frame (rigid motions are not damped):
/// Z = M Phi, d = 2 zeta omega with zeta = frame.modal_damping_ratio.  That none is missing is proved by inertia of a
/// supported frame, see SturmCheckedModes; of a floating one the elastic modes are taken.
/// @throws std::invalid_argument if the frame has fewer coordinates; ConvergenceFailure.
void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress = {});

} // namespace gestell::coupling
