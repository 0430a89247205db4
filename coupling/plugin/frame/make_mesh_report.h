#pragma once

#include "coupling/frame/reduction_options.h"
#include "coupling/plugin/mesh_report.h"
#include "fem/values/frame_specification.h"

namespace gestell::coupling
{

/// Meshes the file of a frame and returns the data for `gestell mesh`; masses are those of
/// frame.material, without one (rho = 0) those of the file, else of steel.
MeshReport mesh_report(const fem::FrameSpecification &frame, const Progress &progress);

} // namespace gestell::coupling
