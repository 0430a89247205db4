#pragma once

#include "apps/scene/file/declaration.h"
#include "apps/scene/file/scene_node.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Of a table with declared keys the first that is none of them, told before what is missing: it may be its
/// misspelling.
std::optional<std::invalid_argument> unknown_key(const SceneNode &table, const std::vector<Key> &declared,
                                                 const std::string &path);

/// Refuses keys that no reader has used, in the table and in the tables below it that were read.
/// @throws std::invalid_argument with the place and the nearest key
void refuse_unknown(const SceneNode &table, const std::string &path);

} // namespace gestell::apps
