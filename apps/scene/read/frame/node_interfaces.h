#pragma once

#include "apps/scene/values/requests.h"

namespace gestell::apps
{

/**
 * Interfaces of coupling "node" have displacements, but no rotations: rejects objects that act on their rotation or
 * depend on it, and points away from them.
 *
 * @throws std::invalid_argument with the location of the object that needs a rotation.
 */
void refuse_rotations_of_nodes(const Scene &scene);

} // namespace gestell::apps
