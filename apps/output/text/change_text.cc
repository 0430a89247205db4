#include "apps/output/text/change_text.h"

#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{

std::string change_text(double here, double there)
{
  if (!std::isfinite(here) || !std::isfinite(there))
    return "";
  if (here == there)
    return "the same";
  if (here == 0.)
    return "";
  if (here * there < 0.)
    return "opposite sign";
  const double     more     = there / here - 1.;
  constexpr double the_same = 1e-9; // rounding of runs
  if (std::abs(more) < the_same)
    return "the same";
  return short_text(100. * std::abs(more), 3) + (more > 0. ? " % larger" : " % smaller");
}

std::string quantity_text(double value, const std::string &si_unit, int digits)
{
  const DisplayUnit shown = display_unit(si_unit, std::abs(value));
  return short_text(value * shown.factor, digits) + (shown.unit.empty() ? "" : " " + shown.unit);
}

} // namespace gestell::apps
