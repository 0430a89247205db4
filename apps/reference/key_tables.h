#pragma once

#include <string>

namespace gestell::apps
{

/// The declared tables in Markdown, as docs/scene/elements.md has them between its markers: keys that many share first,
/// then each table with its sentence, its own keys, signals and examples.
std::string key_tables();

} // namespace gestell::apps
