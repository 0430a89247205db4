#include "apps/cli/team.h"

#include "coupling/plugin/frame_service_loader.h"

#include <exception>
#include <iostream>

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

} // namespace gestell::apps
