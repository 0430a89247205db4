#include "apps/cli/team.h"

#include "apps/cli/command.h"
#include "coupling/frame/frame_recipe.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/plugin.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace gestell::apps
{
namespace
{

std::string working_folder()
{
  std::error_code gone;
  return std::filesystem::current_path(gone).string();
}

/// Ranks exchange values whose form and digits are those of one program.
void require_same_program(const coupling::Launch &launched)
{
  const int n_others = coupling::ranks_called_otherwise(coupling::sources_of_frames(), "");
  if (n_others > 0)
    throw std::invalid_argument(std::string(launched.by) + ": " + std::to_string(n_others) + " of " +
                                std::to_string(launched.size) +
                                " ranks run another build of gestell than rank 0; install the same version, with the "
                                "same gmsh, deal.II and OpenCASCADE, on all computers");
}

/// Ranks compute one task together: different command lines of other ranks would be ignored silently.
void require_same_calls(const coupling::Launch &launched, const std::string &words, int n_others)
{
  if (n_others == 0)
    return;
  throw std::invalid_argument(
      std::string(launched.by) + ": " + std::to_string(n_others) + " of " + std::to_string(launched.size) +
      " ranks were started with another command line or working directory than rank 0 (gestell" + words + ", in " +
      working_folder() +
      "), but all ranks compute one case together; start all of them with the same command, or use " +
      coupling::way_of_cases);
}

} // namespace

MpiRun::MpiRun(const std::string &words) : launch_(coupling::launch()), team_(coupling::team_service())
{
  if (launch_.size == 1)
    return;
  if (!team_)
    throw std::invalid_argument(
        std::string(launch_.by) + ": this build has no finite element part, for which " + std::to_string(launch_.size) +
        " processes could compute together; build it with GESTELL_FEM=ON, or use " + coupling::way_of_cases);
  require_same_program(launch_);
  require_same_calls(launch_, words, coupling::ranks_called_otherwise(words, working_folder()));
}

MpiRun::~MpiRun()
{
  if (team_ && launch_.rank == 0)
    team_->dismiss();
}

void MpiRun::tell_idle() const
{
  if (launch_.size > 1 && launch_.rank == 0 && !coupling::plugin_is_loaded("libgestell_frame.so"))
    std::cerr << "gestell: ranks without work: " + std::to_string(launch_.size - 1) + " of " +
                     std::to_string(launch_.size) + "; no frame had to be computed\n"; // at once: mpirun mixes lines
}

bool MpiRun::serves() const
{
  return launch_.rank > 0;
}

void MpiRun::serve()
{
  if (!team_)
    return;
  try
  {
    team_->serve(coupling::obey_in_frame_service);
  }
  catch (const std::exception &error)
  {
    team_->abort(error.what());
  }
}

namespace
{

coupling::Launch left;

/// Environment variables with these prefixes.
std::vector<std::string> variables_of(const std::vector<std::string> &beginnings)
{
  std::vector<std::string> names;
  for (char **entry = environ; *entry; ++entry)
    for (const std::string &beginning : beginnings)
      if (std::string(*entry).rfind(beginning, 0) == 0)
        names.push_back(std::string(*entry).substr(0, std::string(*entry).find('=')));
  return names;
}

} // namespace

void leave_team()
{
  for (const std::string &name : variables_of({"OMPI_", "PMIX_", "PMI_", "SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}))
    unsetenv(name.c_str());
}

namespace
{

/// In a separate process, because MPI cannot be finalised and initialised again.  @return number of ranks with another
/// command line
int called_otherwise(const std::string &words)
{
  constexpr int none = 50, most = 150; // as exit codes: MPI ends processes that it cannot start with small ones
  const pid_t   child = fork();
  if (child == 0)
    try
    {
      coupling::team_service();
      std::exit(none + std::min(most, coupling::ranks_called_otherwise(words, working_folder())));
    }
    catch (const std::exception &)
    {
      _exit(exit_failed);
    }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) < none)
    return 0; // no common MPI: ranks share only files
  return std::min(most, WEXITSTATUS(status) - none);
}

} // namespace

void part_team(const std::string &words)
{
  left = coupling::launch();
  if (left.size == 1)
    return;
  const int n_others = called_otherwise(words);
  require_same_calls(left, words, n_others);
  leave_team();
}

coupling::Launch team_left()
{
  return left;
}

bool apart_by_environment()
{
  const char *const wanted = std::getenv("GESTELL_APART");
  return wanted && *wanted && wanted != std::string("0");
}

} // namespace gestell::apps
