#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/functions/position_function.h"

#include <memory>
#include <vector>

namespace gestell::apps
{

/// Reads f from `function` or `table`; its argument is called `variable`.
std::shared_ptr<const mechanism::PositionFunction> read_function(const SceneTable &table, const Variable &variable,
                                                                 const Kind &x, const Kind &y);

/// Keys of read_function().
std::vector<Key> function_keys(const Kind &x, const Kind &y);
/// The same for arguments and values that are lengths or angles.
std::vector<Key> position_function_keys();

/// Rejects a periodic `function` f(x) of an ideal joint if it or its slope jumps, with the location.
void refuse_jumps(const SceneTable &table, const mechanism::PositionFunction &f, const Kind &x);

} // namespace gestell::apps
