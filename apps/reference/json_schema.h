#pragma once

#include <string>

namespace gestell::apps
{

/// JSON Schema (2020-12) of the declared tables of a scene, for editors of TOML; what is not declared is left open.  It
/// demands no key, because a scene that extends another gives some of them alone.
std::string json_schema();

} // namespace gestell::apps
