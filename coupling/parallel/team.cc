#include "coupling/parallel/team.h"

#include "coupling/integration/system/second_order_system.h"
#include "coupling/parallel/divided_tasks.h"
#include "coupling/parallel/team_tasks.h"
#include "coupling/plugin/team_service.h"

#include <memory>
#include <string>

namespace gestell::coupling
{

namespace
{

std::unique_ptr<const Team> &the_team()
{
  static std::unique_ptr<const Team> team;
  return team;
}

template <typename Task>
void serve(const fem::Ranks &ranks)
{
  Task task;
  try
  {
    Team::carry_out(task, ranks);
  }
  catch (const fem::AgreedFailure &)
  {
    // rank 0 reports it
  }
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

void obey(int order)
{
  const fem::Ranks ranks;
  switch (RankTask(order))
  {
  case RankTask::prepare:
    return serve<PrepareTask>(ranks);
  case RankTask::divide:
    return serve<DivideTask>(ranks);
  case RankTask::forget_factor:
    return serve<ForgetFactorTask>(ranks);
  case RankTask::factorise:
    return serve<FactoriseTask>(ranks);
  case RankTask::release_factor:
    return serve<ReleaseFactorTask>(ranks);
  case RankTask::solve_divided:
    return serve<SolveDividedTask>(ranks);
  case RankTask::inertia:
    return serve<InertiaTask>(ranks);
  case RankTask::search:
    return serve<SearchTask>(ranks);
  case RankTask::find:
    return serve<FindTask>(ranks);
  case RankTask::found:
    return serve<FoundTask>(ranks);
  case RankTask::end_search:
    return serve<EndSearchTask>(ranks);
  case RankTask::hold:
    return serve<HoldTask>(ranks);
  case RankTask::release:
    return serve<ReleaseTask>(ranks);
  case RankTask::solve:
    return serve<SolveTask>(ranks);
  case RankTask::modes:
    return serve<ModesTask>(ranks);
  case RankTask::count:
    return serve<CountTask>(ranks);
  }
  ranks.abort("there is no order " + std::to_string(order) + "; all ranks must run the same version of gestell");
}

} // namespace gestell::coupling

void gestell_use_team()
{
  using namespace gestell::coupling;
  Team::use();
  PrepareTask prepare;
  if (const Team *team = Team::of_this_run())
    team->together(prepare);
}

void gestell_obey(int order)
{
  gestell::coupling::obey(order);
}
