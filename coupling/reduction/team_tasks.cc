#include "coupling/reduction/team_tasks.h"

#include "coupling/reduction/openblas.h"

#include <map>
#include <memory>

namespace gestell::coupling
{

namespace
{

/// Frames held on this rank, by number.  Never destroyed: at the end of the process MPI has ended before.
std::map<int, std::unique_ptr<SharedHeldFrame>> &held_frames()
{
  static auto *const frames = new std::map<int, std::unique_ptr<SharedHeldFrame>>;
  return *frames;
}

} // namespace

void HoldTask::run(const fem::Ranks &ranks)
{
  ranks.agree([] { use_one_blas_thread(); });
  ranks.broadcast(number);
  auto &held_frame = held_frames()[number];
  try
  {
    held_frame = std::make_unique<SharedHeldFrame>(
        std::make_shared<const SharedMatrices>(ranks, frame ? &frame->C : nullptr, frame ? &frame->M : nullptr), q1);
  }
  catch (const fem::AgreedFailure &)
  {
    held_frames().erase(number);
    throw;
  }
  held = held_frame.get();
}

void ReleaseTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  held_frames().erase(number);
}

void SolveTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  Eigen::MatrixXd             none;
  Eigen::Ref<Eigen::MatrixXd> nothing(none);
  held_frames().at(number)->solve_in_place(X ? *X : nothing);
}

void ModesTask::run(const fem::Ranks &ranks)
{
  ranks.broadcast(number);
  const Eigen::MatrixXd             none;
  Eigen::Ref<const Eigen::MatrixXd> nothing(none);
  modes = held_frames().at(number)->lowest_modes(count, known ? *known : nothing);
}

} // namespace gestell::coupling
