#include "coupling/parallel/team_held_frame.h"

#include "coupling/parallel/team_search.h"
#include "coupling/parallel/team_tasks.h"

#include <utility>

namespace gestell::coupling
{

TeamHeldFrame::TeamHeldFrame(const Team &team, const fem::FrameMatrices &frame, const std::vector<int> &q1)
    : team_(team), n_(int(frame.C.rows())), n_free_(n_ - int(q1.size())), number_(Team::next_number())
{
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

std::unique_ptr<ModeSearch> TeamHeldFrame::search(const BlockLanczos::Options &, const LowestModes &known) const
{
  return std::make_unique<TeamSearch>(*this, known);
}

int TeamHeldFrame::modes_below(double omega) const
{
  CountTask task;
  task.number = number_;
  task.omega  = omega;
  team_.together(task);
  return task.below;
}

} // namespace gestell::coupling
