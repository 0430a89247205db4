#pragma once

#include "coupling/parallel/divided_factor.h"
#include "coupling/parallel/team.h"

#include <string>

namespace gestell::coupling
{

/// Rank 0's handle of a DividedFactor and its mode search: each call runs the task on all ranks.
class TeamFactor
{
public:
  /// Distributes the matrices; no factor yet.  @param matrices  must outlive this.
  TeamFactor(const Team &team, const MatricesOnFirst &matrices);
  ~TeamFactor();
  TeamFactor(const TeamFactor &)            = delete;
  TeamFactor &operator=(const TeamFactor &) = delete;

  /// Computes the factor if needed.  @returns whether all pivots are positive.
  bool   factorise();
  int    failed() const { return failed_; } ///< coordinate of a pivot that is not positive, or -1
  double pivot_ratio() const { return pivot_ratio_; }
  /// Frees its memory.
  void release();
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const;

  /// Inertia of C - omega^2 M; also available after release().
  Inertia below(double omega) const;
  /// See search_modes().
  std::unique_ptr<ModeSearch> search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                     const LowestModes &known) const;

private:
  const Team &team_;
  int         number_;           // of the factor, on all ranks
  int         failed_      = -1; // coordinate
  double      pivot_ratio_ = 0.;
};

} // namespace gestell::coupling
