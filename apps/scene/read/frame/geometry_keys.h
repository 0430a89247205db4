#pragma once

#include "apps/scene/file/declaration.h"

namespace gestell::apps
{

/// Keys of [frame] from CAD or a mesh, or already reduced; of its `mesh`, in addition to patterns of names; of
/// [frame.surface.NAME] and the other tables.
const std::vector<Key> &frame_keys();
const std::vector<Key> &mesh_keys();
const std::vector<Key> &prestress_keys();
const std::vector<Key> &surface_keys();
const std::vector<Key> &support_keys();
const std::vector<Key> &interface_keys();
const std::vector<Key> &cut_keys();
const std::vector<Key> &stress_point_keys();
const std::vector<Key> &attached_mass_keys();

} // namespace gestell::apps
