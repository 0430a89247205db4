#include "apps/cli/team.h"

#include "coupling/plugin/frame_service_loader.h"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

namespace gestell::apps
{

MpiRun::MpiRun() : launch_(coupling::launch()), team_(coupling::team_service())
{
  if (launch_.size > 1 && launch_.rank == 0 && !team_)
    std::cerr << "gestell: this build has no finite element side, so rank 0 of " << launch_.size
              << " computes alone; build it with GESTELL_FEM=ON\n";
}

MpiRun::~MpiRun()
{
  if (team_ && launch_.rank == 0)
    team_->dismiss();
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

/// Variables of the environment that begin so.
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
  left = coupling::launch();
  if (left.size == 1)
    return;
  for (const std::string &name : variables_of({"OMPI_", "PMIX_", "PMI_", "SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}))
    unsetenv(name.c_str());
}

coupling::Launch team_left()
{
  return left;
}

} // namespace gestell::apps
