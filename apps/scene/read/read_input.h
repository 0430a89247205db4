#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/functions/input_value.h"

#include <memory>

namespace gestell::apps
{

/// The key of a course that may be an input as well.
Key or_input(Key course);

/// Reads { input = "NAME" } of a course, which is at `from` until it is set from outside; null if it is no input.
std::shared_ptr<mechanism::InputValue> read_input(const SceneTable &table, const std::string &key, double from);

} // namespace gestell::apps
