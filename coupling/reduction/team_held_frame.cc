#include "coupling/reduction/team_held_frame.h"

#include "coupling/reduction/team_tasks.h"

#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

void require_work_for_all(const fem::FrameMatrices &frame, int n_ranks)
{
  const bool cells = frame.n_cells > 0;
  const int  parts = cells ? frame.n_cells : int(frame.C.rows());
  if (n_ranks > parts)
    throw std::invalid_argument("mpirun: " + std::to_string(n_ranks) + " ranks for a frame of " +
                                std::to_string(parts) + (cells ? " cells" : " coordinates") +
                                ", but each rank needs at least one; start no more than " + std::to_string(parts) +
                                ", or mesh more finely.  Some thousand cells per rank are worth the effort.");
}

int next_number()
{
  static int number = 0;
  return ++number;
}

} // namespace

TeamHeldFrame::TeamHeldFrame(const Team &team, const fem::FrameMatrices &frame, const std::vector<int> &q1)
    : team_(team), number_(next_number())
{
  require_work_for_all(frame, team.ranks().size());
  HoldTask hold;
  hold.number = number_;
  hold.frame  = &frame;
  hold.q1     = &q1;
  team.together(hold);
  shared_ = hold.held;
}

TeamHeldFrame::~TeamHeldFrame()
{
  ReleaseTask release;
  release.number = number_;
  team_.together(release);
}

void TeamHeldFrame::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const
{
  SolveTask solve;
  solve.number = number_;
  solve.X      = &X;
  team_.together(solve);
}

LowestModes TeamHeldFrame::lowest_modes(int count, const Eigen::Ref<const Eigen::MatrixXd> &known) const
{
  ModesTask task;
  task.number = number_;
  task.count  = count;
  task.known  = &known;
  team_.together(task);
  return std::move(task.modes);
}

} // namespace gestell::coupling
