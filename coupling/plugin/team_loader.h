#pragma once

#include "coupling/plugin/team_service.h"

#include <string>

namespace gestell::coupling
{

/// Rank of this process in a launch (mpirun, srun), by its environment variables.
struct Launch
{
  int         rank = 0, size = 1;
  const char *by = "mpirun";
};
Launch launch();

/**
 * The ranks of mpirun as a team: libgestell_team.so, found as the plugin of frame_service() is, which loads MPI alone.
 *
 * The first call must be made by all ranks.
 *
 * @return nullptr where one process runs by itself, or this build has no finite element side.
 * @throws std::invalid_argument if the launcher gave its processes no MPI, or is of another MPI, so that they cannot
 * communicate.
 */
TeamService *team_service();

/// Number of ranks with another command line or folder than rank 0; to be called by all.
int ranks_called_otherwise(const std::string &words, const std::string &folder);

/// Option for a separate case per process: "--apart ..."
extern const char *const way_of_cases;

} // namespace gestell::coupling
