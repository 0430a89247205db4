#pragma once

#include "apps/analysis/life/life_load.h"
#include "apps/analysis/life/life_result.h"
#include "coupling/frame/reduced_frame.h"

#include <vector>

namespace gestell::apps
{

/// Damage of a load at the worst places of a frame, with its error.
LifeResult life_of(const Scene &scene, const coupling::ReducedFrame &frame, const LifeLoad &load);

/// Damage of each cycle of another load at a place, in the direction found there, of extremes between samples.
/// @throws std::runtime_error if the frame has other points
std::vector<double> damages_at(const Scene &scene, const coupling::ReducedFrame &frame, const LifeLoad &load,
                               const LifePlace &place);

} // namespace gestell::apps
