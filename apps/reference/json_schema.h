#pragma once

#include <string>

namespace gestell::apps
{

/// JSON Schema (2020-12) of the declared tables of a scene, for TOML editors; undeclared keys are allowed.  It requires
/// no key, because a scene that extends another contains only some of them.
std::string json_schema();

} // namespace gestell::apps
