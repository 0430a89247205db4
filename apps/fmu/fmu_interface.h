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

/// Inputs of the scene's profiles by name, in the order of elements; several profiles may use the same input.
std::vector<std::pair<std::string, InputHandles>> scene_inputs(const Scene &scene);

/**
 * Variables that other programs can set and read: parameters that are used and independent of others, inputs of
 * profiles, signals.
 *
 * @param root    of the scene's file
 * @param frozen  omitted parameters, on which a reduced frame depends
 * @throws std::invalid_argument if an input has the name of a signal
 */
FmuInterface fmu_interface(const SceneNode &root, const Scene &scene, const coupling::Machine &machine,
                           const std::set<std::string> &frozen);

/// Parameters on which values of the table depend, directly or through others; `parameters` is [parameters] or null.
std::set<std::string> parameters_in(const SceneNode &table, const SceneNode *parameters);

} // namespace gestell::apps
