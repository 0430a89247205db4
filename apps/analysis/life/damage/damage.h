#pragma once

#include "apps/analysis/life/damage/cycles.h"
#include "apps/analysis/life/damage/mean_stress.h"
#include "apps/analysis/life/damage/sn_curve.h"

#include <vector>

namespace gestell::apps
{

/// Linear accumulation of Palmgren and Miner: what cycles below the cut-off of the curve do.
enum class Miner
{
  original,   ///< nothing
  elementary, ///< damage by the last line, prolonged
  /// nothing until the cut-off r_L, which falls with the damage D as r_L (1 - D)^(1/q), q = last slope - 1, reaches
  /// them; then by the last line
  consequent
};

struct DamageRule
{
  SnCurve    curve;
  MeanStress mean_stress;
  Miner      miner = Miner::original;

  /// Range at the curve's R.
  double equivalent_range(const Cycle &cycle) const
  {
    return mean_stress.equivalent_range(cycle.range, cycle.mean, curve.ratio);
  }
};

/**
 * Damage of one repetition of a load and its inverse, the repetitions until failure at D = 1:
 *
 *     D = sum_k n_k / N(r_k)                              (original, elementary)
 *     1/D = integral_0^1 dD' / d(D'),  d(D') = sum of n_k / N(r_k) over r_k >= r_L (1 - D')^(1/q)   (consequent)
 *
 * No damage: D = 0, an infinite life.
 */
double damage_of(const std::vector<Cycle> &cycles, const DamageRule &rule);
/// 1/D.
double repetitions_to_failure(double damage);

/// Part of each cycle in D [cycles]; its sum is D.
std::vector<double> damage_per_cycle(const std::vector<Cycle> &cycles, const DamageRule &rule);

} // namespace gestell::apps
