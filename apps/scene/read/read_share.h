#pragma once

#include "apps/scene/file/scene_table.h"

namespace gestell::apps
{

/// A part of a whole, above 0 and at most 1: 0.15 or "15 %".  Its key is required without a fallback.
/// @throws std::invalid_argument for others, with the place: who writes 15 means percent
double read_share(const SceneTable &table, const std::string &key);
double read_share(const SceneTable &table, const std::string &key, double fallback);

} // namespace gestell::apps
