#pragma once

#include "apps/scene/file/declaration.h"

namespace gestell::apps
{

/// A type of joints or measures with its keys, for readers, help and reference.
struct TypeOfTable
{
  std::string      name, does, signals;
  std::vector<Key> keys; ///< `type` among them
};
const std::vector<TypeOfTable> &joint_types();
const std::vector<TypeOfTable> &measure_types();

/// Keys of one of them.
const std::vector<Key> &keys_of(const std::vector<TypeOfTable> &types, const std::string &name);

/// Of [place.NAME].
const std::vector<Key> &place_keys();

} // namespace gestell::apps
