#include "apps/analysis/life/worst_points.h"

#include "apps/analysis/life/damage_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

namespace gestell::apps
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Row         = Eigen::Matrix<double, 1, 6>;
using PointStress = Eigen::Matrix<double, 6, Eigen::Dynamic>; // S_i [6 x n]

constexpr Index points_of_bounds = 256; // multiplied together
constexpr Index points_of_search = 8;   // evaluated before the next look at the bounds: T x 6 x 8 numbers of stress

/// L with |L sigma| = sigma_v.
const Eigen::Matrix<double, 6, 6> &von_mises_norm()
{
  static const Eigen::Matrix<double, 6, 6> norm = []
  {
    Eigen::Matrix<double, 6, 6> L = Eigen::Matrix<double, 6, 6>::Zero();
    L.topLeftCorner<3, 3>()       = std::sqrt(1.5) * (Eigen::Matrix3d::Identity() - Eigen::Matrix3d::Constant(1. / 3.));
    L.bottomRightCorner<3, 3>()   = std::sqrt(3.) * Eigen::Matrix3d::Identity();
    return L;
  }();
  return norm;
}

const Row &trace_row()
{
  static const Row row = (Row() << 1., 1., 1., 0., 0., 0.).finished();
  return row;
}

/// The stresses of a load at the points of a frame, and the damage that they do.
class PointEvaluation
{
public:
  PointEvaluation(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                  const DamageRule &rule, const DamageSearch &search)
      : stress_(stress), states_(states), load_(load), rule_(rule), search_(search)
  {
    require_valid(load, states.cols());
    require_valid(rule.mean_stress, rule.curve.ratio);
    const std::size_t n = std::size_t(stress.n_points());
    if (states.rows() != stress.mean.cols() || search.counts.size() != n ||
        (!search.directions.empty() && search.directions.size() != n) ||
        (search.distance > 0. && search.position.size() != n))
      throw std::invalid_argument("worst_points: states, directions and positions must fit the " + std::to_string(n) +
                                  " points of the stresses.");
  }

  bool is_signed() const { return search_.measure == StressMeasure::signed_von_mises; }

  /// Rows of the linear measure at a point; none for the signed one.
  MeasureRows rows(int point) const
  {
    if (is_signed())
      return MeasureRows(0, 6);
    return measure_rows(search_.measure,
                        search_.directions.empty() ? SurfaceDirections{} : search_.directions[std::size_t(point)]);
  }

  /// S_i of points, one below the other [6 points x n].
  MatrixXd matrices(const std::vector<int> &points) const
  {
    MatrixXd S(6 * Index(points.size()), stress_.mean.cols());
    for (std::size_t i = 0; i < points.size(); ++i)
      S.middleRows<6>(6 * Index(i)) = search_.factor * stress_.mean.middleRows<6>(6 * Index(points[i])).cast<double>();
    return S;
  }

  /// x(t) = a.z(t) of the rows a [samples x rows].
  MatrixXd histories(const MatrixXd &rows) const { return states_.transpose() * rows.transpose(); }

  double damage(const double *history)
  {
    count_cycles(history, load_, cycles_);
    return damage_of(cycles_, rule_);
  }

  const std::vector<Cycle> &cycles() const { return cycles_; }

  /**
   * Changes of sign of signed_von_mises(S z), with |L sigma| before and after.
   * @param within  samples between which it may change sign inside blocks
   * @param peak    upper bound of |L sigma|
   */
  std::vector<SignJump> sign_jumps(const PointStress &S, const std::vector<LoadBlock> &within, double peak) const
  {
    const VectorXd trace    = (trace_row() * S).transpose();
    const auto     negative = [&](std::int64_t t, double trace_of_t)
    {
      if (trace_of_t >= 0. || trace_of_t < -trace_of_rounding * peak)
        return trace_of_t < 0.;
      return signed_von_mises(S * states_.col(t)) < 0.;
    };
    const PointStress     V = von_mises_norm() * S;
    std::vector<SignJump> jumps;
    const auto            join = [&](std::int64_t a, std::int64_t b, double count) {
      jumps.push_back({(V * states_.col(a)).norm() + (V * states_.col(b)).norm(), count});
    };
    VectorXd history;
    for (const LoadBlock &part : within)
    {
      history.noalias() = states_.middleCols(part.first, part.end - part.first + 1).transpose() * trace;
      bool before       = negative(part.first, history[0]);
      for (Index i = 1; i < history.size(); ++i)
        if (negative(part.first + i, history[i]) != before)
        {
          before = !before;
          join(part.first + i - 1, part.first + i, part.repetitions);
        }
    }
    for (std::size_t b = 0; b < load_.blocks.size(); ++b) // to its own begin, and to the next block
      for (const std::size_t next : {b, (b + 1) % load_.blocks.size()})
      {
        const std::int64_t last = load_.blocks[b].end - 1, first = load_.blocks[next].first;
        if (negative(last, states_.col(last).dot(trace)) != negative(first, states_.col(first).dot(trace)))
          join(last, first, next == b ? load_.blocks[b].repetitions : 1.);
      }
    return jumps;
  }

  /// Signed von Mises stress of stresses [samples x 6].
  static VectorXd signed_history(const Eigen::Ref<const MatrixXd> &sigma)
  {
    const auto           xx = sigma.col(0).array(), yy = sigma.col(1).array(), zz = sigma.col(2).array();
    const Eigen::ArrayXd sigma_v =
        (0.5 * ((xx - yy).square() + (yy - zz).square() + (zz - xx).square()) +
         3. * (sigma.col(3).array().square() + sigma.col(4).array().square() + sigma.col(5).array().square()))
            .sqrt();
    return (xx + yy + zz < -trace_of_rounding * sigma_v).select(-sigma_v, sigma_v);
  }

  /// The worst of `rows`, in their order; one whose bound is at most `enough` or the worst found is left out.
  PointDamage worst_row(int point, const Eigen::Ref<const MatrixXd> &sigma, const MeasureRows &rows,
                        const VectorXd &bound, double enough)
  {
    std::vector<Index> order(std::size_t(rows.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return bound[a] > bound[b]; });
    PointDamage worst{point, 0., rows.row(order.front())};
    VectorXd    history;
    for (const Index i : order)
    {
      if (bound[i] <= std::max(worst.damage, enough))
        break;
      const auto &w = rows.row(i);
      history       = w[0] * sigma.col(0) + w[1] * sigma.col(1) + w[2] * sigma.col(2) + w[3] * sigma.col(3) +
                w[4] * sigma.col(4) + w[5] * sigma.col(5);
      const double damage = this->damage(history.data());
      if (damage > worst.damage)
        worst = {point, damage, rows.row(i)};
    }
    return worst;
  }

private:
  const coupling::ReducedStress &stress_;
  const MatrixXd                &states_;
  const LoadSequence            &load_;
  const DamageRule              &rule_;
  const DamageSearch            &search_;
  std::vector<Cycle>             cycles_;
};

template <typename Visit>
void in_blocks_of(Index size, const std::vector<int> &points, const Visit &visit)
{
  for (std::size_t first = 0; first < points.size(); first += std::size_t(size))
    if (!visit(std::vector<int>(points.begin() + Index(first),
                                points.begin() + Index(std::min(points.size(), first + std::size_t(size))))))
      return;
}

/// Upper bounds of the damage of points.
class PointBounds
{
public:
  PointBounds(const PointEvaluation &evaluation, const MatrixXd &states, const LoadSequence &load,
              const DamageRule &rule, const std::vector<int> &points)
      : evaluation_(evaluation), bounds_(states, load, rule, gram(evaluation, states.rows(), points))
  {
  }

  VectorXd of_points(const std::vector<int> &points) const
  {
    const MatrixXd S = evaluation_.matrices(points), parts = S * bounds_.basis();
    const VectorXd offset = S * bounds_.mean();
    VectorXd       bound(points.size());
    if (evaluation_.is_signed())
    {
      MatrixXd trace(points.size(), parts.cols());
      VectorXd trace_offset(points.size()), peak(points.size());
      for (Index i = 0; i < bound.size(); ++i)
      {
        trace.row(i)    = trace_row() * parts.middleRows<6>(6 * i);
        trace_offset[i] = trace_row() * offset.segment<6>(6 * i);
        peak[i]         = bounds_.peak_of_norm(norms_of(parts.middleRows<6>(6 * i)),
                                               (von_mises_norm() * offset.segment<6>(6 * i)).norm());
      }
      const auto within = bounds_.possible_sign_changes(trace, trace_offset, trace_of_rounding * peak);
      for (Index i = 0; i < bound.size(); ++i)
        bound[i] = bounds_.of_signed_norm(
            norms_of(parts.middleRows<6>(6 * i)), (von_mises_norm() * offset.segment<6>(6 * i)).norm(),
            evaluation_.sign_jumps(S.middleRows<6>(6 * i), within[std::size_t(i)], peak[i]));
      return bound;
    }
    for (Index i = 0; i < bound.size(); ++i)
      bound[i] = of_rows(evaluation_.rows(points[std::size_t(i)]), parts.middleRows<6>(6 * i), offset.segment<6>(6 * i))
                     .maxCoeff();
    return bound;
  }

  /// Of each row of a point.
  VectorXd of_rows(const MeasureRows &rows, const MatrixXd &S) const
  {
    return of_rows(rows, S * bounds_.basis(), S * bounds_.mean());
  }

private:
  static MatrixXd gram(const PointEvaluation &evaluation, Index n, const std::vector<int> &points)
  {
    MatrixXd sum = MatrixXd::Zero(n, n);
    in_blocks_of(points_of_bounds, points,
                 [&](const std::vector<int> &some)
                 {
                   const MatrixXd S = evaluation.matrices(some);
                   sum.noalias() += S.transpose() * S;
                   return true;
                 });
    return sum;
  }

  VectorXd of_rows(const MeasureRows &rows, const PointStress &parts, const coupling::Stress &offset) const
  {
    const MatrixXd norms = (rows * parts).cwiseAbs();
    VectorXd       bound(rows.rows());
    for (Index i = 0; i < rows.rows(); ++i)
      bound[i] = bounds_.of_linear(norms.row(i).transpose().array(), rows.row(i) * offset);
    return bound;
  }

  static Eigen::ArrayXd norms_of(const PointStress &parts)
  {
    return (von_mises_norm() * parts).colwise().norm().transpose().array();
  }

  const PointEvaluation &evaluation_;
  DamageBounds           bounds_;
};

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

/// Damage of points; of a critical plane the planes that may exceed `enough`, all without `bounds`.
std::vector<PointDamage> damage_of_points(PointEvaluation &evaluation, const PointBounds *bounds,
                                          const std::vector<int> &points, double enough)
{
  std::vector<PointDamage> found;
  if (points.empty())
    return found;
  const MatrixXd S = evaluation.matrices(points);
  if (!evaluation.is_signed() && evaluation.rows(points.front()).rows() == 1)
  {
    MatrixXd rows(points.size(), S.cols());
    for (Index i = 0; i < rows.rows(); ++i)
      rows.row(i) = evaluation.rows(points[std::size_t(i)]) * S.middleRows<6>(6 * i);
    const MatrixXd x = evaluation.histories(rows);
    for (Index i = 0; i < rows.rows(); ++i)
      found.push_back(
          {points[std::size_t(i)], evaluation.damage(x.col(i).data()), evaluation.rows(points[std::size_t(i)])});
    return found;
  }
  const MatrixXd sigma = evaluation.histories(S);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto at = sigma.middleCols<6>(6 * Index(i));
    if (evaluation.is_signed())
      found.push_back({points[i], evaluation.damage(PointEvaluation::signed_history(at).data()), Row::Zero()});
    else
    {
      const MeasureRows rows  = evaluation.rows(points[i]);
      const VectorXd    bound = bounds ? bounds->of_rows(rows, S.middleRows<6>(6 * Index(i)))
                                       : VectorXd::Constant(rows.rows(), std::numeric_limits<double>::infinity());
      found.push_back(evaluation.worst_row(points[i], at, rows, bound, enough));
    }
  }
  return found;
}

} // namespace

WorstPoints worst_points(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search)
{
  PointEvaluation  evaluation(stress, states, load, rule, search);
  std::vector<int> points;
  for (int i = 0; i < stress.n_points(); ++i)
    if (search.counts[std::size_t(i)])
      points.push_back(i);
  if (points.empty() || search.worst <= 0)
    return {};
  const PointBounds bounds(evaluation, states, load, rule, points);
  VectorXd          bound(stress.n_points());
  in_blocks_of(points_of_bounds, points,
               [&](const std::vector<int> &some)
               {
                 const VectorXd of_some = bounds.of_points(some);
                 for (std::size_t i = 0; i < some.size(); ++i)
                   bound[some[i]] = of_some[Index(i)];
                 return true;
               });
  std::stable_sort(points.begin(), points.end(), [&](int a, int b) { return bound[a] > bound[b]; });

  Ranking     ranking(search);
  WorstPoints result;
  in_blocks_of(points_of_search, points,
               [&](const std::vector<int> &some)
               {
                 const double next = bound[some.front()];
                 if (next <= ranking.enough())
                   return false;
                 // with a distance a worse point may displace others, so that points below them count again
                 const double     enough = search.distance > 0. ? -1. : ranking.enough();
                 std::vector<int> left;
                 for (const int i : some)
                   if (bound[i] > enough && !ranking.near(i, next))
                     left.push_back(i);
                 ranking.add(damage_of_points(evaluation, &bounds, left, enough));
                 result.looked_at += static_cast<int>(left.size());
                 return true;
               });
  result.worst = ranking.worst();
  return result;
}

PointDamage point_damage(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                         const DamageRule &rule, const DamageSearch &search, int point)
{
  PointEvaluation evaluation(stress, states, load, rule, search);
  return damage_of_points(evaluation, nullptr, {point}, -1.).front();
}

VectorXd stress_history(const coupling::ReducedStress &stress, const MatrixXd &states, const DamageSearch &search,
                        const PointDamage &at)
{
  const MatrixXd S = search.factor * stress.mean.middleRows<6>(6 * Index(at.point)).cast<double>();
  if (search.measure == StressMeasure::signed_von_mises)
    return PointEvaluation::signed_history(states.transpose() * S.transpose());
  return states.transpose() * (at.row * S).transpose();
}

VectorXd damage_shares(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                       const DamageRule &rule, const DamageSearch &search, const PointDamage &at)
{
  const VectorXd            x      = stress_history(stress, states, search, at);
  const std::vector<Cycle>  cycles = count_cycles(x, load);
  const std::vector<double> damage = damage_per_cycle(cycles, rule);
  const double              total  = std::accumulate(damage.begin(), damage.end(), 0.);
  VectorXd                  shares = VectorXd::Zero(states.rows());
  if (!(total > 0.) || !std::isfinite(total))
    return shares;
  const MatrixXd S     = search.factor * stress.mean.middleRows<6>(6 * Index(at.point)).cast<double>();
  const auto     parts = [&](std::int64_t t) -> VectorXd // of the coordinates in x(t)
  {
    const Row row =
        search.measure == StressMeasure::signed_von_mises ? signed_von_mises_row(S * states.col(t)) : at.row;
    return (row * S).transpose().cwiseProduct(states.col(t));
  };
  for (std::size_t k = 0; k < cycles.size(); ++k)
    if (damage[k] > 0.)
      shares +=
          damage[k] / total / (x[cycles[k].end] - x[cycles[k].begin]) * (parts(cycles[k].end) - parts(cycles[k].begin));
  return shares;
}

} // namespace gestell::apps
