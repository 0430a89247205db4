#include "apps/analysis/life/damage/point_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{

/// Bounds are rounded otherwise than the damage.
constexpr double rounding_of_bounds = 1e-9;

MatrixXd stress_gram(const PointStresses &stresses, const std::vector<int> &points)
{
  constexpr Index at_once = 256; // multiplied together
  const Index     n       = stresses.states().rows();
  MatrixXd        sum     = MatrixXd::Zero(n, n);
  in_blocks_of(at_once, points,
               [&](const std::vector<int> &some)
               {
                 const MatrixXd S = stresses.matrices(some);
                 sum.noalias() += S.transpose() * S;
               });
  return sum;
}

/// docs/theory/life.md (8): max |x - x of the coarse load|.
/// @param norms  |a.b_r| [n]
double error_of(const Eigen::Ref<const VectorXd> &norms, const CoarseLoad &load, Index measured)
{
  const Index  others = norms.size() - measured;
  const double of_vector =
      norms.head(measured).norm() * load.distance + norms.tail(others).dot(load.largest.tail(others).matrix());
  return std::min(norms.dot(load.largest.matrix()), of_vector);
}

} // namespace

PointBounds::PointBounds(const PointStresses &stresses, const std::vector<int> &points)
    : stresses_(stresses), states_(principal_states(stresses.states(), stress_gram(stresses, points)))
{
  for (const LoadBlock &block : stresses.load().blocks)
    most_cycles_ += 0.5 * block.repetitions * double(block.end - block.first);
  // loads that are ten times closer from one to the next; before them one without components, of which only the total
  // variation counts, but no sign is known; more than an eighth of all numbers would cost more than they save
  std::vector<double> tolerances{0.1, 0.01, 0.001};
  if (!stresses.is_signed())
    tolerances.insert(tolerances.begin(), 2.);
  for (const double tolerance : tolerances)
  {
    CoarseLoad load = coarse_load(states_, stresses.load(), tolerance, loads_.empty() ? nullptr : &loads_.back());
    if (8 * load.components.size() > states_.components.size())
      break;
    loads_.push_back(std::move(load));
  }
  states_.components.resize(0, 0);
}

/// docs/theory/life.md (7): the damage of cycles_ with turning points that move by `error`, of small cycles and others.
double PointBounds::of_cycles(double error, double variation, double largest, const std::vector<Cycle> &more)
{
  const DamageRule &rule = stresses_.rule();
  error += rounding_of_bounds * std::abs(largest);
  for (const Cycle &cycle : cycles_)
    variation += 2. * cycle.count * cycle.range;
  cycles_.insert(cycles_.end(), more.begin(), more.end());
  for (Cycle &cycle : cycles_)
  {
    cycle.range += 2. * error;
    cycle.mean += error;
  }
  if (error > 0.)
  {
    const double R     = rule.curve.ratio.value_or(-1.); // a cycle of this ratio is its own equivalent
    const double range = 2. * error * rule.mean_stress.largest_factor(largest + error, rule.curve.ratio);
    cycles_.push_back(
        {range, 0.5 * range * (1. + R) / (1. - R), std::min(most_cycles_, variation / (4. * error)), 0, 0});
  }
  return (1. + rounding_of_bounds) * damage_of(cycles_, rule);
}

void PointBounds::compute_histories(const MatrixXd &parts, const VectorXd &offset, const CoarseLoad &load)
{
  histories_.resize(load.components.rows(), parts.rows());
  histories_.noalias() = load.components * parts.leftCols(load.components.cols()).transpose();
  histories_.rowwise() += offset.transpose();
}

VectorXd PointBounds::of_rows(const MatrixXd &parts, const VectorXd &offset, const CoarseLoad &load)
{
  compute_histories(parts, offset, load);
  const MatrixXd norms = parts.cwiseAbs().transpose();
  VectorXd       bound(parts.rows());
  for (Index i = 0; i < bound.size(); ++i)
  {
    count_cycles(histories_.col(i).data(), load.load, cycles_);
    bound[i] = of_cycles(error_of(norms.col(i), load, states_.measured), norms.col(i).dot(load.variation.matrix()),
                         histories_.col(i).maxCoeff());
  }
  return bound;
}

VectorXd PointBounds::of_norms(const MatrixXd &parts, const VectorXd &offset, const CoarseLoad &load)
{
  compute_histories(parts, offset, load);
  VectorXd bound(parts.rows() / 6);
  for (Index i = 0; i < bound.size(); ++i)
  {
    const auto     V           = histories_.middleCols<5>(6 * i);
    const VectorXd norms       = parts.middleRows<5>(6 * i).colwise().norm().transpose();
    const VectorXd traces      = parts.row(6 * i + 5).cwiseAbs().transpose();
    const double   largest     = std::sqrt(V.rowwise().squaredNorm().maxCoeff());
    const double   error       = error_of(norms, load, states_.measured) + rounding_of_bounds * largest;
    const double   trace_error = error_of(traces, load, states_.measured) + trace_of_rounding * (largest + error);
    signed_path({V, histories_.col(6 * i + 5), error, trace_error, traces + trace_of_rounding * norms}, load, path_);
    count_cycles(path_.history.data(), path_.load, cycles_);
    bound[i] = of_cycles(error, path_.variation + norms.dot(load.variation.matrix()), largest, path_.flips);
  }
  return bound;
}

VectorXd PointBounds::of_points(const std::vector<int> &points, int level)
{
  constexpr Index   in_cache = 1 << 14; // numbers of histories that are multiplied together
  const CoarseLoad &load     = loads_[std::size_t(level)];
  VectorXd          bound(points.size());
  Index             first = 0;
  const auto        visit = [&](const std::vector<int> &some)
  {
    const MatrixXd S      = stresses_.matrices(some);
    MatrixXd       parts  = S * states_.basis;
    VectorXd       offset = S * states_.mean;
    const auto     n      = Index(some.size());
    if (stresses_.is_signed())
    {
      for (Index i = 0; i < n; ++i)
      {
        parts.middleRows<6>(6 * i) = (von_mises_and_trace() * parts.middleRows<6>(6 * i)).eval();
        offset.segment<6>(6 * i)   = (von_mises_and_trace() * offset.segment<6>(6 * i)).eval();
      }
      bound.segment(first, n) = of_norms(parts, offset, load);
    }
    else
      for (Index i = 0; i < n; ++i)
      {
        const MeasureRows rows = stresses_.rows(some[std::size_t(i)]);
        bound[first + i] = of_rows(rows * parts.middleRows<6>(6 * i), rows * offset.segment<6>(6 * i), load).maxCoeff();
      }
    first += n;
  };
  in_blocks_of(std::clamp<Index>(in_cache / (6 * load.components.rows()), 1, 64), points, visit);
  return bound;
}

VectorXd PointBounds::of_rows(const MeasureRows &rows, const PointStress &S)
{
  if (loads_.empty())
    return VectorXd::Constant(rows.rows(), std::numeric_limits<double>::infinity());
  const PointStress parts = S * states_.basis;
  return of_rows(rows * parts, rows * (S * states_.mean), loads_.back());
}

} // namespace gestell::apps
