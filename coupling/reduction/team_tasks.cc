#include "coupling/reduction/team_tasks.h"

#include "coupling/reduction/openblas.h"

#include <map>
#include <memory>

namespace gestell::coupling
{

namespace
{

/// What this rank has of matrices and held frames, by number.  Never destroyed: at the end of the process MPI has ended
/// before.
template <typename T>
std::map<int, T> &kept()
{
  static auto *const things = new std::map<int, T>;
  return *things;
}
auto &matrices_kept()
{
  return kept<std::shared_ptr<const SharedMatrices>>();
}
auto &frames_held()
{
  return kept<std::unique_ptr<SharedHeldFrame>>();
}

} // namespace

void AssembleTask::run(const fem::Ranks &ranks)
{
  ranks.agree([] { use_one_blas_thread(); });
  ranks.broadcast(number);
  matrices_kept()[number] = assemble_on_ranks(ranks, source, sums);
}

void ForgetTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  matrices_kept().erase(number);
}

void HoldTask::run(const fem::Ranks &ranks)
{
  ranks.agree([] { use_one_blas_thread(); });
  ranks.broadcast(number);
  ranks.broadcast(matrices);
  const auto shared     = matrices > 0 ? matrices_kept().at(matrices)
                                       : std::make_shared<const SharedMatrices>(ranks, frame ? &frame->C : nullptr,
                                                                            frame ? &frame->M : nullptr);
  auto       made       = std::make_unique<SharedHeldFrame>(shared, q1);
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
