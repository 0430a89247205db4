#include "coupling/parallel/team_tasks.h"

#include "coupling/eigensolvers/blas_threads.h"

#include <map>
#include <memory>

namespace gestell::coupling
{

namespace
{

/// What this rank has of held frames, by number.  Never destroyed: at the end of the process MPI has ended before.
auto &frames_held()
{
  static auto *const kept = new std::map<int, std::unique_ptr<SharedHeldFrame>>;
  return *kept;
}

} // namespace

void HoldTask::run(const fem::Ranks &ranks)
{
  ranks.agree([] { use_one_blas_thread(); });
  ranks.broadcast(number);
  const auto shared =
      std::make_shared<const SharedMatrices>(ranks, frame ? &frame->C : nullptr, frame ? &frame->M : nullptr);
  auto made             = std::make_unique<SharedHeldFrame>(shared, q1);
  held                  = made.get();
  frames_held()[number] = std::move(made);
}

void ReleaseTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  frames_held().erase(number);
}

void SolveTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  Eigen::MatrixXd             none;
  Eigen::Ref<Eigen::MatrixXd> nothing(none);
  frames_held().at(number)->solve_in_place(X ? *X : nothing);
}

void ModesTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  const Eigen::MatrixXd             none;
  Eigen::Ref<const Eigen::MatrixXd> nothing(none);
  modes = frames_held().at(number)->lowest_modes(count, known ? *known : nothing);
}

void CountTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  below = frames_held().at(number)->modes_below(omega);
}

} // namespace gestell::coupling
