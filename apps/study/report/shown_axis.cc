#include "apps/study/report/shown_axis.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

ShownAxis shown_axis(const std::string &name, const std::string &unit, double magnitude)
{
  if (unit.empty())
    return {name, 1., ""};
  const DisplayUnit shown = display_unit(unit, magnitude);
  return {name, shown.factor, shown.unit};
}

ShownAxis shown_axis(const StudyVariable &variable)
{
  return shown_axis(variable.name, variable.unit, std::max(std::abs(variable.from), std::abs(variable.to)));
}

ShownAxis shown_axis(const StudyOutput &output, double magnitude)
{
  return shown_axis(output.name, output.unit, magnitude);
}

double magnitude_of(const Eigen::VectorXd &values)
{
  double largest = 0.;
  for (const double value : values)
    largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : largest;
  return largest;
}

ChartAxis chart_axis(const ShownAxis &axis, double from, double to)
{
  ChartAxis chart;
  chart.label = axis.head();
  chart.begin = axis.shown(from);
  chart.end   = axis.shown(to);
  return chart;
}

} // namespace gestell::apps
