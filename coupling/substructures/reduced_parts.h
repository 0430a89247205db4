#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/frame/reduction_options.h"
#include "coupling/substructures/frame_of_parts.h"

namespace gestell::coupling
{

/// A frame of parts, each reduced (equal ones once, from the cache or stored there), joined, and reduced once more to
/// the retained interfaces.
ReducedFrame reduced_frame_of_parts(const FrameOfParts &frame, const ReductionOptions &options,
                                    const Progress &progress);

} // namespace gestell::coupling
