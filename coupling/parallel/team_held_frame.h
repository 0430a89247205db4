#pragma once

#include "coupling/parallel/held_by_ranks.h"
#include "coupling/parallel/shared_held_frame.h"
#include "coupling/parallel/team.h"
#include "fem/values/frame_matrices.h"

namespace gestell::coupling
{

/// By PETSc, MUMPS and SLEPc: rank 0's hand on a SharedHeldFrame: each call orders all ranks to make theirs.
class TeamHeldFrame final : public HeldByRanks
{
public:
  TeamHeldFrame(const Team &team, const fem::FrameMatrices &frame, const std::vector<int> &q1);
  ~TeamHeldFrame() override;
  TeamHeldFrame(const TeamHeldFrame &)            = delete;
  TeamHeldFrame &operator=(const TeamHeldFrame &) = delete;

  int n() const { return n_; }           ///< coordinates
  int n_free() const { return n_free_; } ///< internal ones

  /// See SharedHeldFrame.
  bool                        factorise() override { return shared_->positive(); }
  double                      softest() const override { return shared_->softest(); }
  void                        release() override {} // by the count alone
  void                        solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const override;
  Inertia                     below(double omega) const override { return {modes_below(omega), 1.}; }
  std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &, const LowestModes &known) const override;
  LowestModes                 lowest_modes(int count, const Eigen::Ref<const Eigen::MatrixXd> &known) const;
  int                         modes_below(double omega) const;

private:
  const Team            &team_;
  int                    n_, n_free_;
  int                    number_; // of the frame, on all ranks
  const SharedHeldFrame *shared_ = nullptr;
};

} // namespace gestell::coupling
