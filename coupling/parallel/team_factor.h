#pragma once

#include "coupling/parallel/divided_factor.h"
#include "coupling/parallel/held_by_ranks.h"
#include "coupling/parallel/team.h"

namespace gestell::coupling
{

/// Rank 0's hand on a DividedFactor, and on the search for modes by it: each call orders all ranks to do theirs.
class TeamFactor final : public HeldByRanks
{
public:
  /// Divided, not yet factored.  @param matrices must outlive this.
  TeamFactor(const Team &team, const MatricesOnFirst &matrices);
  ~TeamFactor() override;
  TeamFactor(const TeamFactor &)            = delete;
  TeamFactor &operator=(const TeamFactor &) = delete;

  bool        factorise() override;
  int         failed() const { return failed_; } ///< coordinate of a pivot that is not positive, or -1
  std::string failed_at() const override;
  double      softest() const override { return pivot_ratio_; }
  void        release() override;
  void        solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const override;

  Inertia                     below(double omega) const override;
  std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const override;

private:
  const Team &team_;
  int         number_;           // of the factor, on all ranks
  int         failed_      = -1; // coordinate
  double      pivot_ratio_ = 0.;
};

} // namespace gestell::coupling
