#include "coupling/factors/petsc_factor.h"
#include "coupling/plugin/team_service.h"

void gestell_use_team()
{
  gestell::coupling::share_factors();
}

void gestell_obey(int order)
{
  gestell::coupling::serve_petsc_factors(order);
}
