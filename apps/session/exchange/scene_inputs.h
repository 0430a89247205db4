#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Adds inputs to a scene, beside those that it has:
 *
 *     slide, crank                a force along a slider, a torque on a rotor
 *     frame.crown.uz, rod.ux      a force along z, x; frame.crown.rz a torque, rod.angle that on a planar body
 *     drive.speed, push.profile   a speed drive or a force profile follows the input instead of the scene's course
 *     NAME=slide                  the same by a name of its own
 *
 * @param root   of the scene's file, changed
 * @param scene  what it was read to
 * @throws std::invalid_argument for a place that is none of these, with the nearest one
 */
void add_scene_inputs(const std::vector<std::string> &inputs, const Scene &scene, SceneNode &root);

} // namespace gestell::apps
