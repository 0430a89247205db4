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
 * The ranks of mpirun as a team: libgestell_team.so, found like the plugin of frame_service(); loads only MPI.
 *
 * The first call must be made by all ranks.
 *
 * @return nullptr for a single process, or if this build has no FEM part.
 * @throws std::invalid_argument if the launcher provides no MPI, or another MPI, so that its processes cannot
 * communicate.
 */
TeamService *team_service();

/// Number of ranks with another command line or folder than rank 0; to be called by all.
int ranks_called_otherwise(const std::string &words, const std::string &folder);

/// Option for a separate case per process: "--apart ..."
extern const char *const way_of_cases;

} // namespace gestell::coupling
