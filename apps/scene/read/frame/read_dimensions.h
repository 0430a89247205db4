#pragma once

#include "apps/scene/file/scene_table.h"

#include <string>

namespace gestell::apps
{

/**
 * Copy of the script (.geo) with the dimensions of `frame`: the first line `NAME = ...;` of each is replaced.  Lengths
 * are converted to the unit of the script, plain numbers are unchanged.  The copy is stored next to the cache of
 * frames, named by a hash of its content, so that equal dimensions share one file.
 *
 * @param cad   path of the script
 * @param unit  its length unit [m]; 0: metre
 * @return path of the copy; `cad` itself if there are no dimensions
 * @throws std::invalid_argument for a file of another kind, a script that reads other files, and for names that it does
 * not assign, with the nearest one
 */
std::string with_dimensions(const SceneTable &frame, const std::string &cad, double unit);

} // namespace gestell::apps
