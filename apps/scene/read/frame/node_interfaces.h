#pragma once

#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/**
 * Interfaces of coupling "node" move, but do not turn: refuses what would act on their rotation or follow it, and
 * points that lie off them.
 *
 * @throws std::invalid_argument with the place of what asks for a rotation.
 */
void refuse_rotations_of_nodes(const Scene &scene);

} // namespace gestell::apps
