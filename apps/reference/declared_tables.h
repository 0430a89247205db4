#pragma once

#include "apps/scene/file/declaration.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table of the scene with its keys, as readers ask for them.
struct DeclaredTable
{
  std::string              path;    ///< "element.rope" for [element.NAME] with type = "rope"
  std::string              does;    ///< one sentence
  std::string              signals; ///< in Markdown; may be empty
  std::vector<Key>         keys;
  std::vector<std::string> examples; ///< in TOML
};

/// All that are declared; to add one, give its reader declared keys and write its line here.
const std::vector<DeclaredTable> &declared_tables();

/// Keys that several tables share under one title.
struct KeyGroup
{
  std::string      title;
  std::vector<Key> keys;
};
const std::vector<KeyGroup> &key_groups();

/// What the key takes, for people: "stiffness [N/m], about an axis [N m], above 0".
std::string taken_by(const Key &key);
/// "0", "none", "demanded".
std::string default_of(const Key &key);

} // namespace gestell::apps
