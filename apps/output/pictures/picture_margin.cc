#include "apps/output/pictures/picture_margin.h"

#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{

std::string axes_triad(const View &view, double x, double y)
{
  std::string svg;
  for (int d = 0; d < 3; ++d)
  {
    const Eigen::Vector2d e = 24. * view.direction(Eigen::Vector3d::Unit(d));
    if (e.norm() < 2.)
      continue;
    svg += svg_line("axis", x, y, x + e[0], y + e[1]);
    svg += svg_text(x + 1.35 * e[0], y + 1.35 * e[1] + 4., std::string(1, "xyz"[d]), "tick", "middle");
  }
  return svg;
}

double round_number(double x)
{
  const double power = std::pow(10., std::floor(std::log10(x) + 1e-12));
  for (const double k : {5., 2.})
    if (x >= k * power * (1. - 1e-9))
      return k * power;
  return power;
}

std::string scale_bar(const View &view, double x, double y, double width)
{
  const double      length = round_number(width / view.scale()), units = length * view.scale();
  const DisplayUnit unit = length < 1. ? DisplayUnit{1e3, "mm"} : DisplayUnit{1., "m"};
  return svg_line("axis", x, y, x + units, y) + svg_line("axis", x, y - 3., x, y + 3.) +
         svg_line("axis", x + units, y - 3., x + units, y + 3.) +
         svg_text(x + 0.5 * units, y - 6., short_text(length * unit.factor) + " " + unit.unit, "small", "middle");
}

} // namespace gestell::apps
