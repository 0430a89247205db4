#include "apps/analysis/life/damage/mean_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace gestell::apps
{

namespace
{

constexpr double infinite_range = std::numeric_limits<double>::infinity();

/// Amplitude at R = -1 of an amplitude 1 with the mean s.
double haigh_factor(double s, double M)
{
  if (s < -1.)
    return 1. - M;
  if (s <= 1.)
    return 1. + M * s;
  return (1. + M) * (1. + std::min(s, 3.) * M / 3.) / (1. + M / 3.);
}

/// Mean over amplitude of a cycle with ratio R = min/max.
double mean_over_amplitude(double R)
{
  return (1. + R) / (1. - R);
}

} // namespace

double MeanStress::equivalent_range(double range, double mean, std::optional<double> ratio) const
{
  if (rule == Rule::eurocode)
    return range - 0.4 * std::clamp(0.5 * range - mean, 0., range);
  if (rule == Rule::none || !ratio || range <= 0.)
    return range;
  mean           = shear ? std::abs(mean) : mean;
  const double s = mean_over_amplitude(*ratio);
  if (rule == Rule::fkm)
    return range * haigh_factor(2. * mean / range, sensitivity) / haigh_factor(s, sensitivity);
  if (mean >= tensile_strength)
    return infinite_range;
  const double reversed = range / (1. - std::max(mean, 0.) / tensile_strength); // at R = -1
  return reversed / (1. + std::max(s, 0.) * 0.5 * reversed / tensile_strength);
}

double MeanStress::neutral_mean(double range, std::optional<double> ratio) const
{
  return 0.5 * range * mean_over_amplitude(rule == Rule::eurocode ? 0. : ratio.value_or(-1.));
}

double MeanStress::largest_factor(double largest_mean, std::optional<double> ratio) const
{
  if (rule == Rule::none || rule == Rule::eurocode || !ratio)
    return 1.;
  if (shear) // the largest mean does not bound its size
    largest_mean = 1.;
  if (rule == Rule::fkm) // grows with the mean, at most to that of R >= 0.5; none of a mean below zero exceeds 1
    return haigh_factor(largest_mean > 0. ? 3. : 0., sensitivity) /
           haigh_factor(mean_over_amplitude(*ratio), sensitivity);
  return largest_mean < tensile_strength ? 1. / (1. - std::max(largest_mean, 0.) / tensile_strength) : infinite_range;
}

void require_valid(const MeanStress &effect, std::optional<double> ratio)
{
  if (effect.rule == MeanStress::Rule::goodman && !(effect.tensile_strength > 0.))
    throw std::invalid_argument("the mean stress effect of Goodman needs the tensile strength; give a positive one.");
  if (effect.rule == MeanStress::Rule::goodman && effect.shear)
    throw std::invalid_argument(
        "the mean stress effect of Goodman is one of normal stress; use that of FKM for shear.");
  if (effect.rule == MeanStress::Rule::fkm && !(effect.sensitivity >= 0. && effect.sensitivity < 1.))
    throw std::invalid_argument("the mean stress sensitivity is " + std::to_string(effect.sensitivity) +
                                "; give a number from 0 to below 1.");
  if (ratio && !(*ratio < 1.))
    throw std::invalid_argument("the stress ratio of the S-N curve is " + std::to_string(*ratio) +
                                "; give R = min/max below 1, for example -1 or 0.");
}

} // namespace gestell::apps
