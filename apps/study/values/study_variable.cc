#include "apps/study/values/study_variable.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

void check_variable(const StudyVariable &variable)
{
  const std::string name = "study: variable " + variable.name + ": ";
  if (!std::isfinite(variable.from) || !std::isfinite(variable.to) || !(variable.from < variable.to))
    throw std::invalid_argument(name + "from " + short_text(variable.from) + " to " + short_text(variable.to) +
                                " is not a range; from must be less than to");
  if (variable.scatter != Scatter::none && !(std::isfinite(variable.width) && variable.width > 0.))
    throw std::invalid_argument(name + "the width of its scatter is " + short_text(variable.width) +
                                "; it must be positive");
}

std::string StudyVariable::text(double level) const
{
  if (!words.empty())
    return words.at(std::size_t(std::lround(level)));
  return exact_text(level) + (unit.empty() ? "" : ' ' + unit);
}

StudyVariable variable_of_levels(StudyVariable variable, std::vector<double> levels)
{
  for (const double level : levels)
    if (!std::isfinite(level))
      throw std::invalid_argument("study: variable " + variable.name + ": a level is not a number");
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  if (levels.size() < 2)
    throw std::invalid_argument("study: variable " + variable.name +
                                ": levels has fewer than two different values; give two or more");
  variable.from   = levels.front();
  variable.to     = levels.back();
  variable.levels = std::move(levels);
  return variable;
}

} // namespace gestell::apps
