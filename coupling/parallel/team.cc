#include "coupling/parallel/team.h"

#include "coupling/integration/system/convergence_failure.h"

#include <memory>

namespace gestell::coupling
{

namespace
{

std::unique_ptr<const Team> &the_team()
{
  static std::unique_ptr<const Team> team;
  return team;
}

} // namespace

const Team *Team::of_this_run()
{
  return the_team().get();
}

void Team::use()
{
  auto team = std::make_unique<const Team>();
  if (team->ranks().size() > 1)
    the_team() = std::move(team);
}

int Team::next_number()
{
  static int number = 0;
  return ++number;
}

void Team::report(const fem::AgreedFailure &failure)
{
  if (failure.kind == fem::AgreedFailure::Kind::wrong_input)
    throw std::invalid_argument(failure.what());
  throw ConvergenceFailure(failure.what());
}

} // namespace gestell::coupling
