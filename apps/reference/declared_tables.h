#pragma once

#include "apps/scene/file/declaration.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table of the scene with its keys, as readers ask for them.
struct DeclaredTable
{
  std::string              path;    ///< "element.rope" for [element.NAME] with type = "rope", else as it is called
  std::string              heading; ///< "[element.NAME]"; "" of the scene itself
  std::string              type;    ///< "rope"; empty: the table has no type, or these keys are those of every type
  std::string              does;    ///< one sentence
  std::string              signals; ///< in Markdown; may be empty
  std::vector<Key>         keys;
  std::vector<std::string> examples; ///< in TOML, below the heading and the type
};

/// All that are declared; to add one, give its reader declared keys and write its line here.
const std::vector<DeclaredTable> &declared_tables();

/// Keys that several tables share under one title.
struct KeyGroup
{
  std::vector<std::string> families; ///< of the tables, "element"; it is listed with the first
  std::string              title;
  std::vector<Key>         keys;
  std::string              of{}; ///< key that is a table of these; empty: they stand in the tables themselves
};
const std::vector<KeyGroup> &key_groups();

/// What the key takes, for people: "stiffness [N/m], about an axis [N m], above 0".
std::string taken_by(const Key &key);
/// "0", "none", "demanded".
std::string default_of(const Key &key);

} // namespace gestell::apps
