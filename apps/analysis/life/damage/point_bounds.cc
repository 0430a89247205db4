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
    : stresses_(stresses),
      mean_(0.5 * (stresses.states().rowwise().maxCoeff() + stresses.states().rowwise().minCoeff())),
      states_(coupling::principal_states(stresses.states().colwise() - mean_, stress_gram(stresses, points)))
{
  for (const LoadBlock &block : stresses.load().blocks)
    most_cycles_ += 0.5 * block.repetitions * double(block.end - block.first);
  // loads that are ten times closer from one to the next; before them one without components, of which only the total
  // variation counts, but no sign is known; more than half of all numbers would save nothing
  std::vector<double> tolerances{0.1, 0.01, 0.001};
  if (!stresses.is_signed())
    tolerances.insert(tolerances.begin(), 2.);
  for (const double tolerance : tolerances)
  {
    CoarseLoad load = coarse_load(states_, stresses.load(), tolerance, loads_.empty() ? nullptr : &loads_.back());
    if (2 * load.components.size() > states_.components.size())
      break;
    loads_.push_back(std::move(load));
  }
  states_.components.resize(0, 0);
}

/// docs/theory/life.md (7): the damage of cycles_ with turning points that move by `error`, of small cycles and others.
double PointBounds::of_cycles(double error, double variation, double largest, const std::vector<Cycle> &more)
{
  const DamageRule &rule   = stresses_.rule();
  const MeanStress &effect = rule.mean_stress;
  error += rounding_of_bounds * std::abs(largest);
  for (const Cycle &cycle : cycles_)
    variation += 2. * cycle.count * cycle.range;
  cycles_.insert(cycles_.end(), more.begin(), more.end());
  for (Cycle &cycle : cycles_)
  {
    cycle.range += 2. * error;
    cycle.mean = (effect.shear ? std::abs(cycle.mean) : cycle.mean) + error;
  }
  if (error > 0.)
  {
    const double range = 2. * error * effect.largest_factor(largest + error, rule.curve.ratio);
    if (!std::isfinite(range)) // a mean above the tensile strength
      return std::numeric_limits<double>::infinity();
    cycles_.push_back(
        {range, effect.neutral_mean(range, rule.curve.ratio), std::min(most_cycles_, variation / (4. * error)), 0, 0});
  }
  return (1. + rounding_of_bounds) * damage_of(cycles_, rule);
}

/// Of histories_.col(i).
double PointBounds::of_linear(Index i, const VectorXd &norms, const CoarseLoad &load)
{
  count_cycles(histories_.col(i).data(), load.load, cycles_);
  return of_cycles(error_of(norms, load, states_.measured), norms.dot(load.variation.matrix()),
                   histories_.col(i).maxCoeff());
}

/// Of six of histories_ from i on.
double PointBounds::of_signed(Index i, const VectorXd &norms, const VectorXd &traces, const CoarseLoad &load)
{
  const auto   V           = histories_.middleCols<5>(i);
  const double largest     = std::sqrt(V.rowwise().squaredNorm().maxCoeff());
  const double error       = error_of(norms, load, states_.measured) + rounding_of_bounds * largest;
  const double trace_error = error_of(traces, load, states_.measured) + trace_of_rounding * (largest + error);
  signed_path({V, histories_.col(i + 5), error, trace_error, traces + trace_of_rounding * norms}, load, path_);
  count_cycles(path_.history.data(), path_.load, cycles_);
  return of_cycles(error, path_.variation + norms.dot(load.variation.matrix()), largest, path_.flips);
}

VectorXd PointBounds::of_rows(const MatrixXd &rows, int level)
{
  const bool  is_signed = stresses_.is_signed();
  const Index each      = is_signed ? 6 : 1;
  VectorXd    bound     = VectorXd::Constant(rows.rows() / each, std::numeric_limits<double>::infinity());
  if (level >= n_levels())
    return bound;
  const CoarseLoad &load   = loads_[std::size_t(level)];
  MatrixXd          parts  = rows * states_.basis;
  VectorXd          offset = rows * mean_;
  if (is_signed)
    for (Index i = 0; i < rows.rows(); i += 6)
    {
      parts.middleRows<6>(i) = (von_mises_and_trace() * parts.middleRows<6>(i)).eval();
      offset.segment<6>(i)   = (von_mises_and_trace() * offset.segment<6>(i)).eval();
    }
  histories_.resize(load.components.rows(), rows.rows());
  histories_.noalias() = load.components * parts.leftCols(load.components.cols()).transpose();
  histories_.rowwise() += offset.transpose();
  for (Index i = 0; i < bound.size(); ++i)
    bound[i] = is_signed ? of_signed(6 * i, parts.middleRows<5>(6 * i).colwise().norm().transpose(),
                                     parts.row(6 * i + 5).cwiseAbs().transpose(), load)
                         : of_linear(i, parts.row(i).cwiseAbs().transpose(), load);
  return bound;
}

} // namespace gestell::apps
