#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/study/file/variable_request.h"

namespace gestell::apps
{

/// [variables.NAME]
VariableRequest read_variable(const SceneNode &node, const SceneTable &table);

} // namespace gestell::apps
