#pragma once

#include "coupling/plugin/frame_service.h"

namespace gestell::coupling
{

/**
 * The FEM part of Gestell, loaded on the first call: libgestell_frame.so from the folder of the running program, or
 * else from the folder in the environment variable GESTELL_PLUGIN_DIR.
 *
 * @throws std::invalid_argument if there is none (a build without the FEM part) or it cannot be loaded.
 */
FrameService &frame_service();

/// Whether there is one: builds without the FEM part have none.
bool has_frame_service();

/// On ranks of mpirun above 0: executes commands of rank 0 in the plugin.
void obey_in_frame_service(int order);

} // namespace gestell::coupling
