#pragma once

#include "apps/scene/scene_node.h"

namespace gestell::apps
{

/**
 * Lets a newer layer of [run], of an extending file or of the command line, replace what an older one says without
 * having to take back every key: another method takes away the parameters of the former one, a tolerance takes the
 * place of a fixed step and the order that went with it.  What came from the command line stays.
 */
void make_way(SceneNode &older, const SceneNode &newer);

} // namespace gestell::apps
