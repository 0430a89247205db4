#pragma once

#include "apps/output/pictures/skin.h"
#include "apps/output/values/scenery.h"

#include <cstddef>

namespace gestell::apps
{

/// The skin of a scenery's frame, displaced for the frame's coordinates p [n_frame].
Skin skin_of(const Scenery &scenery, const Eigen::VectorXd &p);

/// The scenery with a skin of so few triangles that a picture stays small, with 9000 below 150 kB.
Scenery for_pictures(const Scenery &scenery, std::size_t triangles = 9000);

} // namespace gestell::apps
