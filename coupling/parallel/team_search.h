#pragma once

#include "coupling/eigensolvers/block_lanczos.h"
#include "coupling/parallel/team_held_frame.h"

namespace gestell::coupling
{

/// The search of all ranks for the modes of a held frame: SLEPc, see SharedHeldFrame::lowest_modes().
class TeamSearch final : public ModeSearch
{
public:
  /// @param known modes found elsewhere, or none.
  TeamSearch(const TeamHeldFrame &held, LowestModes known);

  void        find(int count) override;
  LowestModes modes(int count) const override;
  Gap         gap_above(int count) const override;

private:
  int gap_index(int count) const;

  const TeamHeldFrame &held_;
  LowestModes          found_;
  bool                 exhausted_ = false; // there were fewer than looked for
};

} // namespace gestell::coupling
