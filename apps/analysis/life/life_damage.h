#pragma once

#include "apps/analysis/life/life_load.h"
#include "apps/analysis/life/life_result.h"
#include "coupling/frame/reduced_frame.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Damage of a load at the worst places of a frame, with its error.
LifeResult life_of(const Scene &scene, const coupling::ReducedFrame &frame, const LifeLoad &load);

/// Damage of another load at a place.
/// @throws std::runtime_error if the frame has other points
double damage_at(const Scene &scene, const coupling::ReducedFrame &frame, const LifeLoad &load, const LifePlace &place);

/// What makes a life doubtful.
std::vector<std::string> life_warnings(const Scene &scene, const LifeResult &found);

} // namespace gestell::apps
