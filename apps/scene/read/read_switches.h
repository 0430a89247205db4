#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// A load as an element, instead of a term of the system's excitation: one that obeys orders, or acts on a measure.
ElementRequest element_of(const LoadRequest &load);

/// The element that was read from `table` begins switched off.
void begin_off(const SceneTable &table, Scene &scene);

/// All [switch.NAME].  Elements that they tell "on" or "off" become ones that can be switched, and loads, springs and
/// dampers of the linear base system become elements of their own for it.
void read_switches(const SceneTable &table, Scene &scene);

/// Of [switch.NAME].
const std::vector<Key> &switch_keys();

} // namespace gestell::apps
