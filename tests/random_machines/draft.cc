#include "tests/random_machines/draft.h"

#include <cstdio>
#include <cstdlib>

namespace gestell::tests
{

std::string digits(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

double rounded(double value)
{
  return std::strtod(digits(value).c_str(), nullptr);
}

std::string vector_text(double x, double y, double z)
{
  return "[" + digits(x) + ", " + digits(y) + ", " + digits(z) + "]";
}

void set_times(Draft &draft, const Scale &scale, double fewest, double most_periods)
{
  draft.machine.period = 2. * M_PI / scale.omega;
  draft.machine.length = scale.length;
  draft.machine.speed  = scale.speed();
  draft.machine.force  = scale.force();
  draft.machine.end    = rounded(draft.machine.period * draft.dice.log_between(fewest, most_periods));
}

double Draft::number(const std::string &key, double value)
{
  line(key + " = " + digits(value));
  return rounded(value);
}

} // namespace gestell::tests
