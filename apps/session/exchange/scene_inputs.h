#pragma once

#include "apps/scene/file/scene_node.h"
#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Adds inputs to a scene, in addition to its own:
 *
 *     slide, crank                a force along a slider, a torque on a rotor
 *     frame.crown.uz, rod.ux      a force along z, x; frame.crown.rz a torque, rod.angle that on a planar body
 *     drive.speed, push.profile   a speed drive or a force profile follows the input instead of the scene's profile
 *     NAME=slide                  the same input with the name NAME
 *
 * @param root   of the scene's file; the inputs are added to it
 * @param scene  the scene read from `root`
 * @throws std::invalid_argument for any other name, with the most similar valid one
 */
void add_scene_inputs(const std::vector<std::string> &inputs, const Scene &scene, SceneNode &root);

} // namespace gestell::apps
