#pragma once

#include "apps/output/pictures/skin.h"
#include "apps/output/values/scenery.h"

namespace gestell::apps
{

/// The skin of a scenery's frame, displaced by the frame's coordinates p [n_frame].
Skin skin_of(const Scenery &scenery, const Eigen::VectorXd &p);

} // namespace gestell::apps
