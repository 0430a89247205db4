#pragma once

#include "coupling/plugin/team_service.h"

namespace gestell::coupling
{

/// This process among those that a launcher (mpirun, srun) started, by what it says in the environment.
struct Launch
{
  int rank = 0, size = 1;
};
Launch launch();

/**
 * The ranks of mpirun as a team: libgestell_team.so, found as the plugin of frame_service() is, which loads MPI alone.
 *
 * The first call must be made by all ranks.
 *
 * @return nullptr where one process runs by itself, or this build has no finite element side.
 * @throws std::invalid_argument if the launcher belongs to another MPI, so that its processes do not find each other.
 */
TeamService *team_service();

} // namespace gestell::coupling
