#pragma once

#include "coupling/plugin/frame_service.h"
#include "coupling/plugin/mesh_report.h"

namespace gestell::coupling
{

/// Meshes the file of a frame and tells what `gestell mesh` tells; masses are those of frame.material.
MeshReport mesh_report(const fem::FrameSpecification &frame, const Progress &progress);

} // namespace gestell::coupling
