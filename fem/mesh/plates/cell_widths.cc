#include "fem/mesh/plates/cell_widths.h"

#include <algorithm>
#include <cmath>

namespace gestell::fem
{

namespace
{

constexpr double growth   = 4.;   ///< from cell to cell: 1/16, 1/4 and 1 of the size
constexpr double rounding = 1e-9; ///< of widths that are sums of widths

/// Narrow cells that grow from a plane.
struct Growing
{
  double              next;
  std::vector<double> along = {0.}; // distances of limits from the plane

  void add()
  {
    along.push_back(along.back() + next);
    next *= growth;
  }
};

/// Adds the narrower ones first, at both planes alike.
void grow(Growing &low, Growing &high, double width, double size)
{
  const auto       left = [&] { return (width - low.along.back() - high.along.back()) * (1. + rounding); };
  constexpr double room = 3.; // widths of a cell that must be left where it is added
  for (double next = std::min(low.next, high.next); next < size && left() >= room * next;
       next        = std::min(low.next, high.next))
  {
    const bool at_low = low.next == next, at_high = high.next == next;
    if (at_low)
      low.add();
    if (at_high)
      high.add();
  }
}

} // namespace

std::vector<double> cell_limits(const Sheet &sheet, double size, int layers, bool even)
{
  constexpr double along_edge = 0.7;      // width of the cell along an edge, of the thickness of the wall
  constexpr double narrowest  = 1. / 16.; // width of the cell along an edge, of the size of cells
  const double     edge       = std::min(along_edge * sheet.thickness, narrowest * size);
  constexpr double at_minor   = 3.; // times as wide at a plane across which most material continues
  const auto       within     = [&](bool minor) { return minor ? at_minor * edge : edge; };
  Growing          low{within(sheet.mostly_goes_on[0])}, high{within(sheet.mostly_goes_on[1])};
  const bool       is_wall = sheet.width() <= sheet.thickness * (1. + rounding);
  if (!is_wall)
    grow(low, high, sheet.width(), size);

  const double     amid   = sheet.width() - low.along.back() - high.along.back();
  const double     narrow = std::min(low.next, high.next) / growth;
  constexpr double jump   = 4.; // from narrow cells to those between, as between two cells
  const double     wide   = low.along.size() + high.along.size() > 2 ? std::min(size, jump * narrow) : size;
  constexpr double thick  = 1. / 4.; // of the size: such walls have two cells through them
  const int        least  = !is_wall ? 1 : std::max(layers, sheet.width() > thick * size ? 2 : 1);
  int              n      = std::max(least, static_cast<int>(std::ceil(amid / wide - rounding)));

  if (even && (n + low.along.size() + high.along.size()) % 2 == 1)
    ++n;
  std::vector<double> limits;
  for (const double x : low.along)
    limits.push_back(sheet.from + x);
  for (int i = 1; i < n; ++i)
    limits.push_back(sheet.from + low.along.back() + amid * i / n);
  for (std::size_t i = high.along.size(); i-- > 0;)
    limits.push_back(sheet.to - high.along[i]);
  return limits;
}

} // namespace gestell::fem
