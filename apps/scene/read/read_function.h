#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/functions/position_function.h"

#include <memory>
#include <vector>

namespace gestell::apps
{

/// f of `function` or `table`, whose argument is called `variable`.
std::shared_ptr<const mechanism::PositionFunction> read_function(const SceneTable &table, const Variable &variable,
                                                                 const Kind &x, const Kind &y);

/// Keys that read_function() asks for.
std::vector<Key> function_keys(const Kind &x, const Kind &y);
/// The same where argument and value are lengths or angles.
std::vector<Key> position_function_keys();

/// Refuses a periodic `function` f(x) of an ideal joint that jumps, or whose slope does, with the place.
void refuse_jumps(const SceneTable &table, const mechanism::PositionFunction &f, const Kind &x);

} // namespace gestell::apps
