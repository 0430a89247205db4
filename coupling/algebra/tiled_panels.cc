#include "coupling/algebra/tiled_panels.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{

/// Numbers of a front of h rows and w columns in tiles.
std::ptrdiff_t tiles_size(std::ptrdiff_t h, std::ptrdiff_t w)
{
  const auto tiles = (h + tile_rows - 1) / tile_rows, rising = w / tile_rows;
  return tile_rows * (tile_rows * rising * (rising + 1) / 2 + (tiles - rising) * w);
}

void put_in_tiles(const double *panel, int h, int w, double *l)
{
  for (int first = 0; first < h;)
  {
    constexpr int tiles_together = 8; // adjacent in the panel
    // Tiles without an end of the front or of the diagonal, side by side: the panel is read in long pieces.
    const int together = first >= w ? std::min(tiles_together, (h - first) / tile_rows) : 0;
    if (together > 1)
    {
      const auto step = std::ptrdiff_t(tile_rows) * w; // from tile to tile
      for (int k = 0; k < w; ++k)
        for (int t = 0; t < together; ++t)
          std::copy_n(panel + first + t * tile_rows + std::ptrdiff_t(k) * h, tile_rows, l + t * step + k * tile_rows);
      l += together * step;
      first += together * tile_rows;
      continue;
    }
    const int rows = std::min(tile_rows, h - first), length = std::min(w, first + tile_rows);
    for (int k = 0; k < length; ++k, l += tile_rows)
    {
      const int     above  = std::max(0, k - first); // of the diagonal
      const double *column = panel + first + std::ptrdiff_t(k) * h;
      std::fill_n(l, above, 0.);
      std::copy(column + above, column + rows, l + above);
      std::fill(l + rows, l + tile_rows, 0.);
    }
    first += tile_rows;
  }
}

} // namespace

TiledPanels::TiledPanels(const Fronts &fronts) : fronts_(fronts), place_(1, 0)
{
  for (int s = 0; s < fronts.count; ++s)
    place_.push_back(place_.back() + tiles_size(height(s), width(s)));
}

void TiledPanels::reserve()
{
  L_ = LargeArray(place_.back());
}

void TiledPanels::put(int front, const double *panel)
{
  put_in_tiles(panel, height(front), width(front), L_.data() + place_[front]);
}

TiledFactor TiledPanels::tiles() const
{
  return {fronts_.n, fronts_.count, fronts_.first, fronts_.begin, fronts_.rows, place_.data(), L_.data()};
}

} // namespace gestell::coupling
