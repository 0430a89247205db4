#pragma once

#include "apps/scene/file/declaration.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table of the scene with the keys of its reader.
struct DeclaredTable
{
  std::string              path;    ///< "element.rope" for [element.NAME] with type = "rope", else its name
  std::string              heading; ///< "[element.NAME]"; "" for the scene itself
  std::string              type;    ///< "rope"; empty: the table has no type, or these keys apply to every type
  std::string              does;    ///< description in one sentence
  std::string              signals; ///< in Markdown; may be empty
  std::vector<Key>         keys;
  std::vector<std::string> examples; ///< in TOML, without the heading and the type
};

/// All declared tables; to add one, declare the keys of its reader and add its line here.
const std::vector<DeclaredTable> &declared_tables();

/// Keys shared by several tables, under one title.
struct KeyGroup
{
  std::vector<std::string> families; ///< of the tables, "element"; it is listed with the first family
  std::string              title;
  std::vector<Key>         keys;
  std::string              of{}; ///< key that is a table of these keys; empty: the keys are in the tables themselves
};
const std::vector<KeyGroup> &key_groups();

/// "`a`, `b`".
std::string quoted_names(const std::vector<Key> &keys);
/// Type of a key, for people: "stiffness [N/m], about an axis [N m], above 0".
std::string taken_by(const Key &key);
/// "0", "none", "required".
std::string default_of(const Key &key);

} // namespace gestell::apps
