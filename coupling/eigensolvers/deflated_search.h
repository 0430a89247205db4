#pragma once

#include "coupling/eigensolvers/block_lanczos.h"

#include <functional>

namespace gestell::coupling
{

/// A search that starts anew for further modes, orthogonal to those known, as SLEPc does.
class DeflatedSearch final : public ModeSearch
{
public:
  /// The lowest `count` modes beside those known, as far as there are so many.
  using Further = std::function<LowestModes(int count, const Eigen::MatrixXd &known)>;

  /// @param n       rows of the modes
  /// @param n_free  modes there are at most
  /// @param known   modes found elsewhere, or none.
  DeflatedSearch(int n, int n_free, Further further, LowestModes known);

  void        find(int count) override;
  LowestModes modes(int count) const override;
  Gap         gap_above(int count) const override;

private:
  int gap_index(int count) const;

  int         n_free_;
  Further     further_;
  LowestModes found_;
  bool        exhausted_ = false; // there were fewer than looked for
};

} // namespace gestell::coupling
