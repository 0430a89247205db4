#include "apps/analysis/life/damage/damage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gestell::apps
{

namespace
{

/// Damage of each cycle while it acts.
double acting_damage(const Cycle &cycle, const DamageRule &rule, bool prolonged)
{
  return cycle.count * rule.curve.damage(rule.equivalent_range(cycle), prolonged);
}

/// Consequent rule: 1/D, and for each cycle the part of the life [repetitions] in which it acts.
struct ConsequentLife
{
  double              life = 0.;
  std::vector<double> acts;
};

ConsequentLife consequent_life(const std::vector<Cycle> &cycles, const DamageRule &rule)
{
  const double             limit = rule.curve.cut_off();
  const double             q     = rule.curve.pieces.back().slope - 1.;
  std::vector<double>      range(cycles.size());
  std::vector<std::size_t> order(cycles.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = 0; k < cycles.size(); ++k)
    range[k] = rule.equivalent_range(cycles[k]);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return range[a] > range[b]; });

  ConsequentLife result{0., std::vector<double>(cycles.size(), 0.)};
  double         damage    = 0.; // d(D')
  double         remaining = 1.; // 1 - D'
  for (std::size_t k = 0; k <= order.size(); ++k)
  {
    // cycles before k act until the limit has fallen to that of k, and then with it
    const double next = k < order.size() && limit > 0. ? std::pow(std::min(1., range[order[k]] / limit), q)
                        : k < order.size()             ? 1.
                                                       : 0.;
    if (next < remaining)
    {
      if (damage == 0.)
        return {std::numeric_limits<double>::infinity(), {}};
      result.life += (remaining - next) / damage;
      remaining = next;
    }
    if (k < order.size())
    {
      result.acts[order[k]] = -result.life; // until now it did not
      damage += acting_damage(cycles[order[k]], rule, true);
    }
  }
  for (double &acts : result.acts)
    acts += result.life;
  return result;
}

} // namespace

double damage_of(const std::vector<Cycle> &cycles, const DamageRule &rule)
{
  if (rule.miner == Miner::consequent)
    return cycles.empty() ? 0. : repetitions_to_failure(consequent_life(cycles, rule).life);
  double damage = 0.;
  for (const Cycle &cycle : cycles)
    damage += acting_damage(cycle, rule, rule.miner == Miner::elementary);
  return damage;
}

double repetitions_to_failure(double damage)
{
  return 1. / damage;
}

std::vector<double> damage_per_cycle(const std::vector<Cycle> &cycles, const DamageRule &rule)
{
  std::vector<double> damage(cycles.size(), 0.);
  if (rule.miner == Miner::consequent)
  {
    const ConsequentLife life = consequent_life(cycles, rule);
    for (std::size_t k = 0; k < life.acts.size(); ++k)
      damage[k] = acting_damage(cycles[k], rule, true) * life.acts[k] / life.life;
    return damage;
  }
  for (std::size_t k = 0; k < cycles.size(); ++k)
    damage[k] = acting_damage(cycles[k], rule, rule.miner == Miner::elementary);
  return damage;
}

} // namespace gestell::apps
