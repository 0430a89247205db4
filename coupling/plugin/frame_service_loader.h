#pragma once

#include "coupling/plugin/frame_service.h"

namespace gestell::coupling
{

/**
 * The heavy half of Gestell, loaded on the first call: libgestell_frame.so from the folder of the running program or
 * else from the folder that the environment variable GESTELL_PLUGIN_DIR names.
 *
 * @throws std::invalid_argument if there is none (a build without the finite element side) or it cannot be loaded.
 */
FrameService &frame_service();

/// Whether there is one: builds without the finite element side have none.
bool has_frame_service();

/// Ranks of mpirun above 0: what rank 0 orders, done by the plugin.
void obey_in_frame_service(int order);

} // namespace gestell::coupling
