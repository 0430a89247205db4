#include "coupling/parallel/obey.h"

#include "coupling/parallel/divided_tasks.h"

namespace gestell::coupling
{

namespace
{

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
  }
  ranks.abort("there is no order " + std::to_string(order) + "; all ranks must run the same version of gestell");
}

} // namespace gestell::coupling
