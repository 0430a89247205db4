#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/// A load as an element, instead of a term of the system's excitation: if it accepts commands or acts on a measure.
ElementRequest element_of(const LoadRequest &load);

/// Makes the element that was read from `table` initially switched off.
void begin_off(const SceneTable &table, Scene &scene);

/// Reads all [switch.NAME].  Elements that are the target of the command "on" or "off" become switchable; loads,
/// springs and dampers of the linear base system are replaced by elements for this.
void read_switches(const SceneTable &table, Scene &scene);

/// Keys of [switch.NAME].
const std::vector<Key> &switch_keys();

} // namespace gestell::apps
