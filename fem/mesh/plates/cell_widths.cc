#include "fem/mesh/plates/cell_widths.h"

#include <algorithm>
#include <cmath>

namespace gestell::fem
{

namespace
{

constexpr double narrowest = 1. / 8.; // cell along an edge, of the size
constexpr double growth    = 4.;      // from cell to cell
constexpr double jump      = 8.;      // from the narrow cells to those amid them
constexpr double rounding  = 1e-9;

} // namespace

std::vector<double> cell_limits(const Sheet &sheet, double size, int layers)
{
  const double        width = sheet.width(), edge = std::min(sheet.thickness, narrowest * size);
  std::vector<double> along = {0.}; // distances of limits from either plane
  double              next  = edge;
  if (width > 3. * edge)
    while (next < size && width - 2. * (along.back() + next) >= next)
    {
      along.push_back(along.back() + next);
      next *= growth;
    }
  const double amid  = width - 2. * along.back();
  const double wide  = along.size() > 1 ? std::min(size, jump * next / growth) : size;
  const int    least = width <= sheet.thickness * (1. + rounding) ? layers : 1;
  const int    n     = std::max(least, static_cast<int>(std::ceil(amid / wide - rounding)));

  std::vector<double> limits;
  for (const double x : along)
    limits.push_back(sheet.from + x);
  for (int i = 1; i < n; ++i)
    limits.push_back(sheet.from + along.back() + amid * i / n);
  for (std::size_t i = along.size(); i-- > 0;)
    limits.push_back(sheet.to - along[i]);
  return limits;
}

} // namespace gestell::fem
