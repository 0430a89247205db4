#include "coupling/plugin/team_loader.h"

#include "coupling/plugin/plugin.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

constexpr const char *team_library = "libgestell_team.so";

/// Variables of a launcher for the number of processes and the own place among them.
struct Launcher
{
  const char *by, *size, *rank;
};
constexpr Launcher launchers[] = {{"mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                  {"mpirun", "PMI_SIZE", "PMI_RANK"},
                                  {"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};

/// Refuses processes that srun started without MPI. The other launchers set the variables above only with MPI.
void require_mpi(const Launch &launched)
{
  if (launched.by != std::string("srun") || std::getenv("PMIX_RANK") || std::getenv("PMIX_NAMESPACE"))
    return;
  throw std::invalid_argument(
      "srun: started " + std::to_string(launched.size) +
      " processes without a common MPI, so they cannot share one computation; use srun --mpi=pmix, or " + way_of_cases);
}

void *team_plugin()
{
  static void *const plugin = load_plugin(find_plugin(team_library));
  return plugin;
}

template <typename Function>
Function *team_function(const char *name)
{
  return reinterpret_cast<Function *>(function_of_plugin(team_plugin(), name, team_library));
}

TeamService *load_team()
{
  const Launch launched = launch();
  if (launched.size == 1)
    return nullptr;
  require_mpi(launched);
  if (find_plugin(team_library).empty())
    return nullptr;
  TeamService *const team = team_function<TeamService *()>("gestell_team_service")();
  if (team->size() != launched.size)
    throw std::invalid_argument(
        std::string(launched.by) + ": started " + std::to_string(launched.size) + " processes, but MPI finds " +
        std::to_string(team->size()) +
        ": the launcher belongs to an MPI other than Gestell's; use the mpirun of Gestell's MPI "
        "(Debian: package openmpi-bin), or srun --mpi=pmix, or " +
        way_of_cases);
  return team;
}

} // namespace

const char *const way_of_cases = "--apart (or GESTELL_APART=1) for a separate case per process";

Launch launch()
{
  for (const auto &[by, size, rank] : launchers)
    if (const char *many = std::getenv(size), *own = std::getenv(rank); many && own)
      return std::atoi(many) > 1 ? Launch{std::atoi(own), std::atoi(many), by} : Launch{}; // the innermost decides
  return {};
}

TeamService *team_service()
{
  static TeamService *const team = load_team();
  return team;
}

int ranks_called_otherwise(const std::string &words, const std::string &folder)
{
  return team_function<int(const char *, const char *)>("gestell_ranks_called_otherwise")(words.c_str(),
                                                                                          folder.c_str());
}

} // namespace gestell::coupling
