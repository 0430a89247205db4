#pragma once

#include "coupling/plugin/team_service.h"

#include <string>

namespace gestell::coupling
{

/// This process among those that a launcher (mpirun, srun) started, by what it says in the environment.
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
 * @throws std::invalid_argument if the launcher gave its processes no MPI, or belongs to another one, so that they do
 * not find each other.
 */
TeamService *team_service();

/// How many ranks were called otherwise than rank 0, by other words or in another folder; to be called by all.
int ranks_called_otherwise(const std::string &words, const std::string &folder);

/// What a user says who wants a case per process: "--apart ..."
extern const char *const way_of_cases;

} // namespace gestell::coupling
