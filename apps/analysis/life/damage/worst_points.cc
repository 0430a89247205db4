#include "apps/analysis/life/damage/worst_points.h"

#include "apps/analysis/life/damage/point_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace gestell::apps
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The worst points found so far, greedy with a distance.
class Ranking
{
public:
  explicit Ranking(const DamageSearch &search) : search_(search) {}

  void add(const std::vector<PointDamage> &found)
  {
    found_.insert(found_.end(), found.begin(), found.end());
    std::sort(found_.begin(), found_.end(),
              [](const PointDamage &a, const PointDamage &b)
              { return a.damage != b.damage ? a.damage > b.damage : a.point < b.point; });
    worst_.clear();
    for (const PointDamage &candidate : found_)
      if (worst_.size() < std::size_t(search_.worst) && !near(candidate.point, 0.))
        worst_.push_back(candidate);
  }

  /// A point with at most this damage changes nothing.
  double enough() const { return worst_.size() == std::size_t(search_.worst) ? worst_.back().damage : -1.; }

  /// `point` is closer than the distance to one of the worst that has at least the damage `bound`.
  bool near(int point, double bound) const
  {
    if (search_.distance <= 0.)
      return false;
    const auto &x = search_.position;
    return std::any_of(worst_.begin(), worst_.end(),
                       [&](const PointDamage &chosen) {
                         return chosen.damage >= bound &&
                                (x[std::size_t(chosen.point)] - x[std::size_t(point)]).norm() < search_.distance;
                       });
  }

  const std::vector<PointDamage> &worst() const { return worst_; }

private:
  const DamageSearch      &search_;
  std::vector<PointDamage> found_, worst_;
};

struct BoundOfPoint
{
  double bound = 0.;
  int    point = -1;
  int    level = 0; ///< of the next closer one; all levels: count the cycles

  /// Order of the queue: largest bound first, then the first point.
  bool operator<(const BoundOfPoint &other) const
  {
    return bound != other.bound ? bound < other.bound : point > other.point;
  }
};

/// Damage of points; of a critical plane the planes that may exceed `enough`, all without `bounds`.
std::vector<PointDamage> damage_of_points(PointStresses &stresses, PointBounds *bounds, const std::vector<int> &points,
                                          double enough)
{
  std::vector<PointDamage> found;
  if (points.empty())
    return found;
  const MatrixXd S = stresses.matrices(points);
  if (!stresses.is_signed() && stresses.rows(points.front()).rows() == 1)
  {
    MatrixXd rows(points.size(), S.cols());
    for (Index i = 0; i < rows.rows(); ++i)
      rows.row(i) = stresses.rows(points[std::size_t(i)]) * S.middleRows<6>(6 * i);
    const MatrixXd x = stresses.histories(rows);
    for (Index i = 0; i < rows.rows(); ++i)
      found.push_back(
          {points[std::size_t(i)], stresses.damage(x.col(i).data()), stresses.rows(points[std::size_t(i)])});
    return found;
  }
  const MatrixXd sigma = stresses.histories(S);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto at = sigma.middleCols<6>(6 * Index(i));
    if (stresses.is_signed())
      found.push_back({points[i], stresses.damage(signed_history(at).data()), StressRow::Zero()});
    else
    {
      const MeasureRows rows  = stresses.rows(points[i]);
      const VectorXd    bound = bounds ? bounds->of_rows(rows, S.middleRows<6>(6 * Index(i)))
                                       : VectorXd::Constant(rows.rows(), std::numeric_limits<double>::infinity());
      found.push_back(stresses.worst_row(points[i], at, rows, bound, enough));
    }
  }
  return found;
}

} // namespace

WorstPoints worst_points(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search)
{
  PointStresses    stresses(stress, states, load, rule, search);
  std::vector<int> points;
  for (int i = 0; i < stress.n_points(); ++i)
    if (search.counts[std::size_t(i)])
      points.push_back(i);
  if (points.empty() || search.worst <= 0)
    return {};
  PointBounds                       bounds(stresses, points);
  std::priority_queue<BoundOfPoint> queue;
  const auto                        bound_closer = [&](const std::vector<int> &some, int level)
  {
    const VectorXd bound = level < bounds.n_levels()
                               ? bounds.of_points(some, level)
                               : VectorXd::Constant(Index(some.size()), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < some.size(); ++i)
      queue.push({bound[Index(i)], some[i], level + 1});
  };
  bound_closer(points, 0);

  // multiplied together: samples x 6 x 8 numbers of stress
  constexpr std::size_t at_once = 8;
  Ranking               ranking(search);
  WorstPoints           result;
  while (!queue.empty() && queue.top().bound > ranking.enough())
  {
    const double     next  = queue.top().bound;
    const int        level = queue.top().level;
    std::vector<int> some;
    for (;
         !queue.empty() && some.size() < at_once && queue.top().bound > ranking.enough() && queue.top().level == level;
         queue.pop())
      if (!ranking.near(queue.top().point, next))
        some.push_back(queue.top().point);
    if (some.empty())
      continue;
    if (level < bounds.n_levels())
    {
      bound_closer(some, level);
      continue;
    }
    // with a distance a worse point may displace others, so that points below them count again
    ranking.add(damage_of_points(stresses, &bounds, some, search.distance > 0. ? -1. : ranking.enough()));
    result.looked_at += static_cast<int>(some.size());
  }
  result.worst = ranking.worst();
  return result;
}

PointDamage point_damage(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search, int point)
{
  PointStresses stresses(stress, states, load, rule, search);
  return damage_of_points(stresses, nullptr, {point}, -1.).front();
}

VectorXd stress_history(const coupling::ReducedStress &stress, const MatrixXd &states, const DamageSearch &search,
                        const PointDamage &at)
{
  const MatrixXd S = search.factor * stress.mean.middleRows<6>(6 * Index(at.point)).cast<double>();
  if (search.measure == StressMeasure::signed_von_mises)
    return signed_history(states.transpose() * S.transpose());
  return states.transpose() * (at.row * S).transpose();
}

VectorXd damage_shares(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                       const DamageRule &rule, const DamageSearch &search, const PointDamage &at,
                       const OtherCoordinates &z)
{
  const VectorXd            x      = stress_history(stress, states, search, at);
  const std::vector<Cycle>  cycles = count_cycles(x, load);
  const std::vector<double> damage = damage_per_cycle(cycles, rule);
  const double              total  = std::accumulate(damage.begin(), damage.end(), 0.);
  VectorXd                  shares = VectorXd::Zero(states.rows());
  if (!(total > 0.) || !std::isfinite(total))
    return shares;
  const MatrixXd S     = search.factor * stress.mean.middleRows<6>(6 * Index(at.point)).cast<double>();
  const bool     other = z.T.size() > 0;
  const MatrixXd S_z   = other ? MatrixXd(S * z.T) : S;
  const auto     parts = [&](std::int64_t t) -> VectorXd // of the coordinates in x(t)
  {
    const StressRow row =
        search.measure == StressMeasure::signed_von_mises ? signed_von_mises_row(S * states.col(t)) : at.row;
    return (row * S_z).transpose().cwiseProduct((other ? z.z : states).col(t));
  };
  for (std::size_t k = 0; k < cycles.size(); ++k)
    if (damage[k] > 0.)
      shares +=
          damage[k] / total / (x[cycles[k].end] - x[cycles[k].begin]) * (parts(cycles[k].end) - parts(cycles[k].begin));
  return shares;
}

} // namespace gestell::apps
