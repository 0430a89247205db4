#pragma once

#include "apps/output/values/fmu_description.h"
#include "apps/scene/file/scene_node.h"
#include "apps/scene/values/requests.h"
#include "mechanism/functions/input_value.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace gestell::apps
{

using InputHandles = std::vector<std::shared_ptr<mechanism::InputValue>>;

/// Inputs of the scene's courses by name, in the order of elements; several courses may follow the same one.
std::vector<std::pair<std::string, InputHandles>> scene_inputs(const Scene &scene);

/**
 * What other programs may set and read of a scene: parameters that something depends on and that follow from no other,
 * inputs of courses, signals.
 *
 * @param root    of the file that the scene was read from
 * @param frozen  parameters that are left out: a frame that was reduced before depends on them
 * @throws std::invalid_argument if an input has the name of a signal
 */
FmuInterface fmu_interface(const SceneNode &root, const Scene &scene, const coupling::Machine &machine,
                           const std::set<std::string> &frozen);

/// Parameters that values of the table depend on, directly or by others; `parameters` is [parameters] or null.
std::set<std::string> parameters_in(const SceneNode &table, const SceneNode *parameters);

} // namespace gestell::apps
