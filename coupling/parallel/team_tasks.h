#pragma once

#include "coupling/parallel/shared_held_frame.h"
#include "coupling/parallel/team.h"
#include "fem/values/frame_matrices.h"

namespace gestell::coupling
{

// The tasks of Team.  What rank 0 puts in is not read on other ranks; `number` names a held frame.

struct HoldTask
{
  static constexpr RankTask order  = RankTask::hold;
  int                       number = 0;
  const fem::FrameMatrices *frame  = nullptr;
  const std::vector<int>   *q1     = nullptr;
  const SharedHeldFrame    *held   = nullptr; ///< made by run()
  void                      run(const fem::Ranks &ranks);
};

struct ReleaseTask
{
  static constexpr RankTask order  = RankTask::release;
  int                       number = 0;
  void                      run(const fem::Ranks &ranks);
};

struct SolveTask
{
  static constexpr RankTask    order  = RankTask::solve;
  int                          number = 0;
  Eigen::Ref<Eigen::MatrixXd> *X      = nullptr;
  void                         run(const fem::Ranks &ranks);
};

struct ModesTask
{
  static constexpr RankTask                order  = RankTask::modes;
  int                                      number = 0, count = 0;
  const Eigen::Ref<const Eigen::MatrixXd> *known = nullptr;
  LowestModes                              modes; ///< found by run()
  void                                     run(const fem::Ranks &ranks);
};

struct CountTask
{
  static constexpr RankTask order  = RankTask::count;
  int                       number = 0;
  double                    omega  = 0.;
  int                       below  = 0; ///< counted by run()
  void                      run(const fem::Ranks &ranks);
};

} // namespace gestell::coupling
