#pragma once

#include "fem/mesh/geometry_report.h"
#include "fem/mesh/gmsh_child.h"
#include "fem/mesh/size_field.h"
#include "fem/process/child.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <vector>

namespace gestell::fem
{

/// The work of make_mesh(), report_geometry() and inspect_geometry() (mesher.h), in this process; gmsh is left
/// finalised.  Phases are those of mesh_phase.
Mesh mesh_of_frame(const MeshAttempt &attempt, const ChildProgress &progress, const std::vector<SizePoint> &refined);
GeometryReport report_of_frame(const MeshAttempt &attempt, const ChildProgress &progress);
GeometryReport inspection_of_frame(const FrameSpecification &specification);

} // namespace gestell::fem
