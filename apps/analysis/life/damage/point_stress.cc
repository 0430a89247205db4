#include "apps/analysis/life/damage/point_stress.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gestell::apps
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

const StressRow &trace_row()
{
  static const StressRow row = (StressRow() << 1., 1., 1., 0., 0., 0.).finished();
  return row;
}

VectorXd signed_history(const Eigen::Ref<const MatrixXd> &sigma)
{
  const auto           xx = sigma.col(0).array(), yy = sigma.col(1).array(), zz = sigma.col(2).array();
  const Eigen::ArrayXd sigma_v =
      (0.5 * ((xx - yy).square() + (yy - zz).square() + (zz - xx).square()) +
       3. * (sigma.col(3).array().square() + sigma.col(4).array().square() + sigma.col(5).array().square()))
          .sqrt();
  return (xx + yy + zz < -trace_of_rounding * sigma_v).select(-sigma_v, sigma_v);
}

PointStresses::PointStresses(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
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

MeasureRows PointStresses::rows(int point) const
{
  if (is_signed())
    return MeasureRows(0, 6);
  return measure_rows(search_.measure,
                      search_.directions.empty() ? SurfaceDirections{} : search_.directions[std::size_t(point)]);
}

MatrixXd PointStresses::matrices(const std::vector<int> &points) const
{
  MatrixXd S(6 * Index(points.size()), stress_.mean.cols());
  for (std::size_t i = 0; i < points.size(); ++i)
    S.middleRows<6>(6 * Index(i)) = search_.factor * stress_.mean.middleRows<6>(6 * Index(points[i])).cast<double>();
  return S;
}

double PointStresses::damage(const double *history)
{
  count_cycles(history, load_, cycles_);
  return damage_of(cycles_, rule_);
}

PointDamage PointStresses::worst_row(int point, const Eigen::Ref<const MatrixXd> &sigma, const MeasureRows &rows,
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

std::vector<SizeCount> PointStresses::sign_jumps(const PointStress &S, const std::vector<LoadBlock> &within,
                                                 double peak) const
{
  const VectorXd trace    = (trace_row() * S).transpose();
  const auto     negative = [&](std::int64_t t, double trace_of_t)
  {
    if (trace_of_t >= 0. || trace_of_t < -trace_of_rounding * peak)
      return trace_of_t < 0.;
    return signed_von_mises(S * states_.col(t)) < 0.;
  };
  const PointStress      V = von_mises_norm() * S;
  std::vector<SizeCount> jumps;
  const auto             join = [&](std::int64_t a, std::int64_t b, double count) {
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

} // namespace gestell::apps
