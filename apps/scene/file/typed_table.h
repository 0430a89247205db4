#pragma once

#include "apps/scene/file/scene_table.h"

#include <algorithm>

namespace gestell::apps
{

/// Types of tables, each with a `name` and `keys`.
template <class Type, class... Makers>
std::vector<Type> made(Makers... makers)
{
  return {makers()...};
}

template <class Type>
std::vector<std::string> names_of(const std::vector<Type> &types)
{
  std::vector<std::string> names;
  for (const Type &type : types)
    names.push_back(type.name);
  return names;
}

/// The same with the key `type`, which selects one of them, before their other keys.
template <class Type>
std::vector<Type> with_type(std::vector<Type> types)
{
  const std::vector<std::string> names = names_of(types);
  for (Type &type : types)
    type.keys.insert(type.keys.begin(), key::choice("type", names, false, "what it is"));
  return types;
}

/// The type of a table; keys of `own` are allowed in addition to those of any type.
template <class Type>
const Type &type_of(const SceneTable &table, const std::vector<Type> &types, const std::vector<Key> &own = {})
{
  static const std::vector<Key> all = [&, keys = own]() mutable
  {
    for (const Type &type : types)
      keys.insert(keys.end(), type.keys.begin(), type.keys.end());
    return keys;
  }();
  const std::string name = table.declared(all).choice("type");
  return *std::find_if(types.begin(), types.end(), [&](const Type &type) { return type.name == name; });
}

} // namespace gestell::apps
