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

/// The one whose order it is.
template <typename... Tasks>
bool serve_one_of(int order, const fem::Ranks &ranks)
{
  return ((order == int(Tasks::order) && (serve<Tasks>(ranks), true)) || ...);
}

} // namespace

void obey(int order)
{
  const fem::Ranks ranks;
  if (!serve_one_of<PrepareTask, DivideTask, ForgetFactorTask, FactoriseTask, ReleaseFactorTask, SolveDividedTask,
                    InertiaTask, SearchTask, FindTask, FoundTask, EndSearchTask>(order, ranks))
    ranks.abort("there is no command " + std::to_string(order) + "; all ranks must run the same version of gestell");
}

} // namespace gestell::coupling
