#include "coupling/parallel/team_factor.h"

#include "coupling/parallel/divided_tasks.h"

namespace gestell::coupling
{

namespace
{

/// The search of all ranks for modes, as rank 0 uses it.
class DividedSearch final : public ModeSearch
{
public:
  DividedSearch(const Team &team, int search) : team_(team), search_(search) {}
  ~DividedSearch() override { team_.together(EndSearchTask{search_}); }
  DividedSearch(const DividedSearch &)            = delete;
  DividedSearch &operator=(const DividedSearch &) = delete;

  void        find(int count) override { own_ = team_.together(FindTask{search_, count}).found; }
  LowestModes modes(int count) const override { return team_.together(FoundTask{search_, count}).modes; }
  Gap         gap_above(int count) const override { return own_->gap_above(count); }

private:
  const Team       &team_;
  int               search_;
  const ModeSearch *own_ = nullptr; // rank 0's part
};

} // namespace

TeamFactor::TeamFactor(const Team &team, const MatricesOnFirst &matrices) : team_(team), number_(Team::next_number())
{
  team.together(DivideTask{number_, matrices});
}

TeamFactor::~TeamFactor()
{
  team_.together(ForgetFactorTask{number_});
}

bool TeamFactor::factorise()
{
  const auto made = team_.together(FactoriseTask{number_});
  pivot_ratio_    = made.pivot_ratio;
  failed_         = made.failed;
  return failed_ < 0;
}

void TeamFactor::release()
{
  team_.together(ReleaseFactorTask{number_});
}

void TeamFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const
{
  team_.together(SolveDividedTask{number_, &X});
}

Inertia TeamFactor::below(double omega) const
{
  return team_.together(InertiaTask{number_, omega * omega}).inertia;
}

std::unique_ptr<ModeSearch> TeamFactor::search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                               const LowestModes &known) const
{
  const int search = Team::next_number();
  team_.together(SearchTask{number_, search, eigensolver, options, &known});
  return std::make_unique<DividedSearch>(team_, search);
}

} // namespace gestell::coupling
