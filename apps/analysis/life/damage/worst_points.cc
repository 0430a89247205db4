#include "apps/analysis/life/damage/worst_points.h"

#include "apps/analysis/life/damage/point_bounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <set>
#include <utility>

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

  /// `point` is, or is closer than the distance to, one of the worst that has at least the damage `bound`.
  bool near(int point, double bound) const
  {
    const auto &x = search_.position;
    return std::any_of(worst_.begin(), worst_.end(),
                       [&](const PointDamage &chosen)
                       {
                         return chosen.damage >= bound &&
                                (chosen.point == point ||
                                 (search_.distance > 0. &&
                                  (x[std::size_t(chosen.point)] - x[std::size_t(point)]).norm() < search_.distance));
                       });
  }

  const std::vector<PointDamage> &worst() const { return worst_; }

private:
  const DamageSearch      &search_;
  std::vector<PointDamage> found_, worst_;
};

/// A row of the measure at a point, or all of its rows.
struct Candidate
{
  double bound = 0.;
  int    point = -1;
  int    row   = -1; ///< negative: all
  int    level = 0;  ///< of the next closer bound; all levels: count the cycles

  /// Order of the queue: largest bound first, then the first point and row.
  bool operator<(const Candidate &other) const
  {
    return bound != other.bound ? bound < other.bound : std::pair(point, row) > std::pair(other.point, other.row);
  }
};

/// Rows a of x = a.z, or S of a signed measure.
MatrixXd rows_of(const PointStresses &stresses, int point)
{
  const MatrixXd S = stresses.matrices({point});
  return stresses.is_signed() ? S : MatrixXd(stresses.rows(point) * S);
}

MatrixXd rows_of(const PointStresses &stresses, const std::vector<Candidate> &some)
{
  const Index each = stresses.is_signed() ? 6 : 1;
  MatrixXd    rows(each * Index(some.size()), stresses.states().rows());
  for (std::size_t i = 0; i < some.size(); ++i)
    rows.middleRows(each * Index(i), each) = rows_of(stresses, some[i].point).middleRows(some[i].row, each);
  return rows;
}

std::vector<PointDamage> count(PointStresses &stresses, const std::vector<Candidate> &some)
{
  std::vector<PointDamage> found;
  const MatrixXd           x = stresses.histories(rows_of(stresses, some));
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    const auto [bound, point, row, level] = some[i];
    if (stresses.is_signed())
      found.push_back(
          {point, stresses.damage(signed_history(x.middleCols<6>(6 * Index(i))).data()), StressRow::Zero()});
    else
      found.push_back({point, stresses.damage(x.col(Index(i)).data()), stresses.rows(point).row(row)});
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
  PointBounds                    bounds(stresses, points);
  const int                      first_level = std::min(1, bounds.n_levels());
  std::priority_queue<Candidate> queue;
  for (const int point : points)
  {
    const VectorXd bound = bounds.of_rows(rows_of(stresses, point), 0);
    queue.push({bound.maxCoeff(), point, bound.size() > 1 ? -1 : 0, first_level});
  }

  // multiplied together: samples x 6 x 8 numbers of stress
  constexpr std::size_t at_once = 8;
  Ranking               ranking(search);
  std::set<int>         looked_at;
  while (!queue.empty() && queue.top().bound > ranking.enough())
  {
    const Candidate        next = queue.top();
    std::vector<Candidate> some;
    for (; !queue.empty() && some.size() < at_once && queue.top().bound > ranking.enough() &&
           queue.top().level == next.level && (queue.top().row < 0) == (next.row < 0);
         queue.pop())
      if (!ranking.near(queue.top().point, next.bound))
        some.push_back(queue.top());
    if (next.row < 0)
      for (const Candidate &all : some)
      {
        const VectorXd bound = bounds.of_rows(rows_of(stresses, all.point), 0);
        for (Index i = 0; i < bound.size(); ++i)
          queue.push({bound[i], all.point, int(i), first_level});
      }
    else if (next.level < bounds.n_levels())
    {
      const VectorXd bound = bounds.of_rows(rows_of(stresses, some), next.level);
      for (std::size_t i = 0; i < some.size(); ++i)
        queue.push({std::min(some[i].bound, bound[Index(i)]), some[i].point, some[i].row, next.level + 1});
    }
    else
    {
      ranking.add(count(stresses, some));
      for (const Candidate &counted : some)
        looked_at.insert(counted.point);
    }
  }
  return {ranking.worst(), int(looked_at.size())};
}

PointDamage point_damage(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search, int point)
{
  PointStresses  stresses(stress, states, load, rule, search);
  const MatrixXd S = stresses.matrices({point});
  if (stresses.is_signed())
    return {point, stresses.damage(signed_history(stresses.histories(S)).data()), StressRow::Zero()};
  const MeasureRows rows = stresses.rows(point);
  if (rows.rows() == 1)
    return {point, stresses.damage(stresses.histories(rows * S).data()), rows};
  const MatrixXd sigma = stresses.histories(S);
  PointDamage    worst{point, 0., rows.row(0)};
  for (Index i = 0; i < rows.rows(); ++i)
  {
    const VectorXd x      = sigma * rows.row(i).transpose();
    const double   damage = stresses.damage(x.data());
    if (damage > worst.damage)
      worst = {point, damage, rows.row(i)};
  }
  return worst;
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
