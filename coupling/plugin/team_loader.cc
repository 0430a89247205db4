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

/// Variables of launchers for the number of processes and the own place among them.
constexpr const char *launchers[][2] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                        {"PMI_SIZE", "PMI_RANK"},
                                        {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};

TeamService *load_team()
{
  const Launch launched = launch();
  const auto   file     = find_plugin(team_library);
  if (launched.size == 1 || file.empty())
    return nullptr;
  void *const plugin = load_plugin(file);
  const auto  entry =
      reinterpret_cast<TeamService *(*)()>(function_of_plugin(plugin, "gestell_team_service", team_library));
  TeamService *const team = entry();
  if (team->size() != launched.size)
    throw std::invalid_argument("mpirun: started " + std::to_string(launched.size) + " processes, but MPI finds " +
                                std::to_string(team->size()) +
                                ": the launcher belongs to another MPI than the one Gestell is built with; use the "
                                "mpirun of that one (Debian: package openmpi-bin), or srun --mpi=pmix");
  return team;
}

} // namespace

Launch launch()
{
  for (const auto &[size, rank] : launchers)
    if (const char *many = std::getenv(size), *own = std::getenv(rank); many && own && std::atoi(many) > 1)
      return {std::atoi(own), std::atoi(many)};
  return {};
}

TeamService *team_service()
{
  static TeamService *const team = load_team();
  return team;
}

} // namespace gestell::coupling
