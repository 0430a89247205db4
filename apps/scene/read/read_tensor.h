#pragma once

#include "apps/scene/file/scene_table.h"

#include <Eigen/Core>

namespace gestell::apps
{

/// Reads two perpendicular directions from `key`, and returns them with the third one as columns.
Eigen::Matrix3d read_axes(const SceneTable &table, const std::string &key);

/// `principal_axes`, used together with three moments.
Key principal_axes_key();

/// Reads `inertia` [kg m^2] in global axes: three moments about these or about `principal_axes`, or the tensor itself.
Eigen::Matrix3d read_tensor(const SceneTable &table);

/// A value for all directions or `[x, y, z]`, none below zero; zero by default.
Key     per_direction_key(const std::string &name, const Kind &kind, const std::string &meaning);
Vector3 read_per_direction(const SceneTable &table, const std::string &key, const Kind &kind);

} // namespace gestell::apps
