#pragma once

#include "apps/scene/file/scene_table.h"

#include <string>

namespace gestell::apps
{

/**
 * The script (.geo) with the dimensions of `frame` in the places of its own: of each the first line `NAME = ...;` is
 * written anew.  Lengths are given in the unit of the script, plain numbers as they are.  The copy is kept beside the
 * cache of frames under a name of its content, so that equal dimensions are one file.
 *
 * @param cad   path of the script
 * @param unit  its length unit [m]; 0: metre
 * @return path of the copy; `cad` itself if there are no dimensions
 * @throws std::invalid_argument for a file of another kind, a script that reads other files, and for names that it does
 * not assign, with the nearest one
 */
std::string with_dimensions(const SceneTable &frame, const std::string &cad, double unit);

} // namespace gestell::apps
