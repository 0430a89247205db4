#pragma once

#include "apps/scene/file/declaration.h"

namespace gestell::apps
{

/// Keys of the scene itself, of [reduction], [start] and [modes].
const std::vector<Key> &scene_keys();
const std::vector<Key> &reduction_keys();
const std::vector<Key> &start_keys();
const std::vector<Key> &modes_keys();

} // namespace gestell::apps
