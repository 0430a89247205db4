#pragma once

#include "coupling/parallel/divided_factor.h"
#include "coupling/parallel/team.h"

#include <string>

namespace gestell::coupling
{

// The tasks of Team with distributed factors.  Inputs of rank 0 are not read on other ranks; `number`: of a factor.

/// The other ranks load their libraries while rank 0 reads and meshes; it does not wait for them.
struct PrepareTask
{
  static constexpr RankTask order = RankTask::prepare;
  void                      run(const fem::Ranks &) {}
};

struct DivideTask
{
  static constexpr RankTask order  = RankTask::divide;
  int                       number = 0;
  MatricesOnFirst           matrices{};
  void                      run(const fem::Ranks &ranks);
};

struct ForgetFactorTask
{
  static constexpr RankTask order  = RankTask::forget_factor;
  int                       number = 0;
  void                      run(const fem::Ranks &ranks);
};

struct FactoriseTask
{
  static constexpr RankTask order       = RankTask::factorise;
  int                       number      = 0;
  int                       failed      = -1; ///< set by run(), as the following members
  double                    pivot_ratio = 0.;
  void                      run(const fem::Ranks &ranks);
};

struct ReleaseFactorTask
{
  static constexpr RankTask order  = RankTask::release_factor;
  int                       number = 0;
  void                      run(const fem::Ranks &ranks);
};

struct SolveDividedTask
{
  static constexpr RankTask    order  = RankTask::solve_divided;
  int                          number = 0;
  Eigen::Ref<Eigen::MatrixXd> *X      = nullptr;
  void                         run(const fem::Ranks &ranks);
};

struct InertiaTask
{
  static constexpr RankTask order  = RankTask::inertia;
  int                       number = 0;
  double                    sigma  = 0.;
  Inertia                   inertia{}; ///< set by run()
  void                      run(const fem::Ranks &ranks);
};

/// A new mode search on all ranks, for a factor.
struct SearchTask
{
  static constexpr RankTask order  = RankTask::search;
  int                       number = 0, search = 0; ///< `search` identifies the search
  std::string               eigensolver{};
  BlockLanczos::Options     options{};
  const LowestModes        *known = nullptr;
  void                      run(const fem::Ranks &ranks);
};

struct FindTask
{
  static constexpr RankTask order  = RankTask::find;
  int                       search = 0, count = 0;
  const ModeSearch         *found = nullptr; ///< rank 0's search, set by run()
  void                      run(const fem::Ranks &ranks);
};

struct FoundTask
{
  static constexpr RankTask order  = RankTask::found;
  int                       search = 0, count = 0;
  LowestModes               modes{}; ///< collected by run()
  void                      run(const fem::Ranks &ranks);
};

struct EndSearchTask
{
  static constexpr RankTask order  = RankTask::end_search;
  int                       search = 0;
  void                      run(const fem::Ranks &ranks);
};

} // namespace gestell::coupling
