#pragma once

#include "coupling/frame/frame_recipe.h"
#include "coupling/frame/reduced_frame.h"
#include "coupling/substructures/frame_of_parts.h"

#include <functional>
#include <vector>

namespace gestell::coupling
{

/// Inputs of the joined frame: the recipes of its parts, their placements, and their joints.
/// @throws std::invalid_argument if a file cannot be read.
Recipe recipe_of(const FrameOfParts &frame, const ReductionOptions &options);

/// Reduces a part in its own coordinates.
using PartReduction = std::function<ReducedFrame(const FramePart &)>;

/// One frame per part, in their order; among parts with equal recipes only the first is reduced.
std::vector<ReducedFrame> equal_parts_once(const FrameOfParts &frame, const ReductionOptions &options,
                                           const PartReduction &reduce);

} // namespace gestell::coupling
