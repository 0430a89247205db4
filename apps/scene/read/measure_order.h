#pragma once

#include "apps/scene/file/scene_table.h"

#include <vector>

namespace gestell::apps
{

/**
 * The order in which tables [measure.NAME] can be read: a sum or a position function after the measures that it names;
 * otherwise that of the file.
 *
 * @return indices of `measures`
 * @throws std::invalid_argument for a measure that is defined by itself, with the names of the cycle
 */
std::vector<std::size_t> reading_order(const std::vector<SceneTable> &measures);

} // namespace gestell::apps
