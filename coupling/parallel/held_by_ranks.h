#pragma once

#include "coupling/eigensolvers/block_lanczos.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace gestell::coupling
{

/// A frame with its interface held whose factor lies on several ranks, as rank 0 uses it; see FixedInterfaceFrame.
class HeldByRanks
{
public:
  virtual ~HeldByRanks() = default;

  /// Makes the factor of C22 where it is not there.  @returns whether all pivots are positive.
  virtual bool factorise() = 0;
  /// " at coordinate 7", where that is known of a pivot that is not.
  virtual std::string failed_at() const { return ""; }
  /// How near the factor is to a singular one: rounding if a motion is free.
  virtual double softest() const = 0;
  /// Gives its memory back.
  virtual void release() = 0;

  virtual void                        solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const                          = 0;
  virtual Inertia                     below(double omega) const                                                    = 0;
  virtual std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const = 0;
};

} // namespace gestell::coupling
