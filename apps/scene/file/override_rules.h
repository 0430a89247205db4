#pragma once

#include "apps/scene/file/scene_node.h"

namespace gestell::apps
{

/// Whether a value was given by `--set`.
bool from_command_line(const SceneNode &node);

/**
 * Lets a newer layer of [run], of an extending file or of the command line, replace what an older one says without
 * having to take back every key: another method takes away the parameters of the former one, a tolerance takes the
 * place of a fixed step and the order that went with it.  What came from the command line stays.
 */
void make_way(SceneNode &older, const SceneNode &newer);

/**
 * The same of [frame] in a whole scene: a reduced frame takes the place of all that the older layer says of its frame
 * and of [reduction], for both lie in its file; another frame takes the place of a reduced one.
 */
void make_way_for_frame(SceneNode &older_scene, const SceneNode &newer_frame);

/// The same of [start]: a steady start by angles, speeds and a driver takes the place of given coordinates, and the
/// other way round.
void make_way_for_start(SceneNode &older, const SceneNode &newer);

} // namespace gestell::apps
