#include "coupling/parallel/team_factor.h"

#include "coupling/parallel/divided_tasks.h"

#include <utility>

namespace gestell::coupling
{

namespace
{

/// The search of all ranks for modes, as rank 0 uses it.
class DividedSearch final : public ModeSearch
{
public:
  DividedSearch(const Team &team, SearchTask task) : team_(team), search_(task.search) { team.together(task); }
  ~DividedSearch() override
  {
    EndSearchTask end;
    end.search = search_;
    team_.together(end);
  }
  DividedSearch(const DividedSearch &)            = delete;
  DividedSearch &operator=(const DividedSearch &) = delete;

  void find(int count) override
  {
    FindTask task;
    task.search = search_;
    task.count  = count;
    team_.together(task);
    own_ = task.found;
  }
  LowestModes modes(int count) const override
  {
    FoundTask task;
    task.search = search_;
    task.count  = count;
    team_.together(task);
    return std::move(task.modes);
  }
  Gap gap_above(int count) const override { return own_->gap_above(count); }

private:
  const Team       &team_;
  int               search_;
  const ModeSearch *own_ = nullptr; // rank 0's part
};

} // namespace

TeamFactor::TeamFactor(const Team &team, const MatricesOnFirst &matrices) : team_(team), number_(Team::next_number())
{
  DivideTask task;
  task.number   = number_;
  task.matrices = matrices;
  team.together(task);
}

TeamFactor::~TeamFactor()
{
  ForgetFactorTask task;
  task.number = number_;
  team_.together(task);
}

bool TeamFactor::factorise()
{
  FactoriseTask task;
  task.number = number_;
  team_.together(task);
  pivot_ratio_ = task.pivot_ratio;
  failed_      = task.failed;
  return failed_ < 0;
}

void TeamFactor::release()
{
  ReleaseFactorTask task;
  task.number = number_;
  team_.together(task);
}

void TeamFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const
{
  SolveDividedTask task;
  task.number = number_;
  task.X      = &X;
  team_.together(task);
}

Inertia TeamFactor::below(double omega) const
{
  InertiaTask task;
  task.number = number_;
  task.sigma  = omega * omega;
  team_.together(task);
  return task.inertia;
}

std::unique_ptr<ModeSearch> TeamFactor::search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                               const LowestModes &known) const
{
  SearchTask task;
  task.number      = number_;
  task.search      = Team::next_number();
  task.eigensolver = eigensolver;
  task.options     = options;
  task.known       = &known;
  return std::make_unique<DividedSearch>(team_, task);
}

} // namespace gestell::coupling
