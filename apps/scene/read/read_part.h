#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/**
 * Reads mass, inertia and position of a body from the CAD file or mesh named in its table: `cad`, `unit`, `placement`,
 * and one of `material`, `density` and `mass`.  The inertia of a rotor is about its axis through `position`, by default
 * through the centre of mass.
 *
 * @param table  of the body, with keys of any type
 * @param scene  with the [material.NAME]
 * @param body   with its kind and axis
 */
void read_part(const SceneTable &table, const SceneTable &scene, BodyRequest &body, fem::Scripts scripts);

/// Reads `placement`, the transformation from the file's coordinates: x = at + Q x_file; Q is a rotation about an
/// `axis`, for parts of a frame with a reflection before.
coupling::Placement read_placement(const SceneTable &table);

/// Keys of read_part() except `mass`, `position` and values from the file.
std::vector<Key> part_keys();

} // namespace gestell::apps
