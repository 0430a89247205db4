#pragma once

#include "coupling/eigensolvers/sturm_check.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"

#include <vector>

namespace gestell::coupling
{

/// The fixed-interface modes of a frame.
class FixedInterfaceModes final : public SturmCheckedModes
{
public:
  /// Both must outlive this; the frame's factor may be released outside of searches.
  FixedInterfaceModes(FixedInterfaceFrame &held, const fem::FrameMatrices &frame, const std::vector<int> &q1,
                      const BlockLanczos::Options &options = {});

private:
  int                         n() const override;
  LowestModes                 all() const override;
  void                        restore() override { held_.restore(); }
  void                        release() override { held_.release(); }
  Inertia                     below(double omega) override { return held_.below(omega); }
  std::unique_ptr<ModeSearch> search(const BlockLanczos::Options &options, const LowestModes &known) const override;

  FixedInterfaceFrame      &held_;
  const fem::FrameMatrices &frame_;
  std::vector<int>          q2_;
};

} // namespace gestell::coupling
