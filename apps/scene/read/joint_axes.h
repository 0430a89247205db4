#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/names.h"
#include "apps/scene/values/requests.h"

#include <string>

namespace gestell::apps
{

/// The axes of a joint that turns about some.
/// @throws std::invalid_argument for bodies that have no direction, or turn about other axes only
void read_axes(const SceneTable &table, const Names &names, JointRequest &joint);

/// A body that turns about its own axis turns about one askew to it by no angle.
/// @throws std::invalid_argument if `axis` is one
void check_no_skew_axis(const SceneTable &table, const Names &names, const std::string &marker, const Vector3 &axis);

} // namespace gestell::apps
