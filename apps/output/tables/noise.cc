#include "apps/output/tables/noise.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

void Noise::see(const std::string &unit, double value)
{
  if (std::isfinite(value))
    largest_[unit] = std::max(largest_[unit], std::abs(value));
}

double Noise::without(const std::string &unit, double value) const
{
  const auto       found       = largest_.find(unit);
  constexpr double noise_share = 1e-9; // of the largest value of a unit: chosen; tables print six digits
  return found != largest_.end() && std::abs(value) < noise_share * found->second ? 0. : value;
}

} // namespace gestell::apps
