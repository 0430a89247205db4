#pragma once

#include "coupling/plugin/mesh_report.h"
#include "fem/values/frame_specification.h"

namespace gestell::coupling
{

/// The unit of length of a frame's file: that which a STEP file says, of other files the one of the specification, or
/// the metre.
LengthUnit file_unit(const fem::FrameSpecification &frame);

} // namespace gestell::coupling
