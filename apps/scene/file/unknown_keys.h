#pragma once

#include "apps/scene/file/declaration.h"
#include "apps/scene/file/scene_node.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The first undeclared key of a table with declared keys.  It is reported before missing keys, because it may be a
/// misspelling of one.
std::optional<std::invalid_argument> unknown_key(const SceneNode &table, const std::vector<Key> &declared,
                                                 const std::string &path);

/// Rejects keys that no reader has used, in the table and in its inner tables that were read.
/// @throws std::invalid_argument with the location and the most similar key
void refuse_unknown(const SceneNode &table, const std::string &path);

} // namespace gestell::apps
