#pragma once

#include "coupling/algebra/kernel_types.h"
#include "coupling/algebra/large_array.h"
#include "coupling/algebra/multifrontal.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gestell::coupling
{

/// The columns of L of some fronts in the layout of TiledFactor; the fronts must outlive it.
class TiledPanels
{
public:
  TiledPanels() = default;
  /// Without numbers: reserve(), then put().
  explicit TiledPanels(const Fronts &fronts);

  std::ptrdiff_t size() const { return place_.back(); } ///< numbers, stored or not
  void           reserve();
  /// @param panel  [rows x columns], of which the lower triangle is used.
  void put(int front, const double *panel);
  void release() { L_ = LargeArray(); }
  bool released() const { return !L_.data(); }

  TiledFactor tiles() const;

  /// Calls visit(column, its diagonal entry).
  template <typename Visit>
  void for_each_pivot(const Visit &visit) const
  {
    for (int s = 0; s < fronts_.count; ++s)
    {
      const double *l = L_.data() + place_[s];
      for (int k = fronts_.first[s], t = 0; k < fronts_.first[s + 1]; ++t) // tile by tile
      {
        const int columns = std::min(tile_rows, fronts_.first[s + 1] - k);
        l += std::ptrdiff_t(t) * tile_rows * tile_rows;
        for (int j = 0; j < columns; ++j, ++k)
          visit(k, l[j * (tile_rows + 1)]);
        l += std::ptrdiff_t(columns) * tile_rows;
      }
    }
  }

private:
  int height(int s) const { return fronts_.begin[s + 1] - fronts_.begin[s]; }
  int width(int s) const { return fronts_.first[s + 1] - fronts_.first[s]; }

  Fronts                      fronts_;
  std::vector<std::ptrdiff_t> place_ = {0}; // [fronts + 1] of their tiles in L
  LargeArray                  L_;
};

} // namespace gestell::coupling
