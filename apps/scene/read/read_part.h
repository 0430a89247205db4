#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/**
 * Mass, inertia and position of a body from the CAD file or mesh that its table names: `cad`, `unit`, `placement`, and
 * one of `material`, `density` and `mass`.  Of a rotor the inertia is about its axis through `position`, by default
 * through the centre of mass.
 *
 * @param table  of the body, with keys of any type
 * @param scene  with the [material.NAME]
 * @param body   with its kind and axis
 */
void read_part(const SceneTable &table, const SceneTable &scene, BodyRequest &body, fem::Scripts scripts);

/// `placement`: where the file's coordinates lie, x = at + Q x_file; turned about an `axis`, of parts of a frame
/// mirrored before.
coupling::Placement read_placement(const SceneTable &table);

/// Keys of it beside `mass`, `position` and those that the file tells.
std::vector<Key> part_keys();

} // namespace gestell::apps
