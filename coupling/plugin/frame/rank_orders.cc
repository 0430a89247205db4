#include "coupling/parallel/divided_tasks.h"
#include "coupling/parallel/obey.h"
#include "coupling/plugin/team_service.h"

void gestell_use_team()
{
  using namespace gestell::coupling;
  Team::use();
  if (const Team *team = Team::of_this_run())
    team->together(PrepareTask{});
}

void gestell_obey(int order)
{
  gestell::coupling::obey(order);
}
