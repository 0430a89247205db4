#pragma once

#include "coupling/reduction/shared_held_frame.h"
#include "coupling/reduction/team.h"
#include "fem/cell_sums.h"

namespace gestell::coupling
{

/// Rank 0's hand on a SharedHeldFrame: each call orders all ranks to make theirs.
class TeamHeldFrame
{
public:
  /// @param rows what the ranks have of the frame's C and M; nullptr: they are dealt out.
  /// @throws std::invalid_argument if there are more ranks than cells, or coordinates where there are no cells.
  TeamHeldFrame(const Team &team, const fem::FrameMatrices &frame, const std::vector<int> &q1,
                const fem::RowsOnRanks *rows = nullptr);
  ~TeamHeldFrame();
  TeamHeldFrame(const TeamHeldFrame &)            = delete;
  TeamHeldFrame &operator=(const TeamHeldFrame &) = delete;

  int n() const { return n_; }           ///< coordinates
  int n_free() const { return n_free_; } ///< internal ones

  /// See SharedHeldFrame.
  bool        positive() const { return shared_->positive(); }
  double      softest() const { return shared_->softest(); }
  void        solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const;
  LowestModes lowest_modes(int count, const Eigen::Ref<const Eigen::MatrixXd> &known) const;
  int         modes_below(double omega) const;

private:
  const Team            &team_;
  int                    n_, n_free_;
  int                    number_; // of the frame, on all ranks
  const SharedHeldFrame *shared_ = nullptr;
};

} // namespace gestell::coupling
