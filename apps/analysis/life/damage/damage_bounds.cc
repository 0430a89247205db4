#include "apps/analysis/life/damage/damage_bounds.h"

#include "coupling/integration/system/dense_solvers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gestell::apps
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Bounds are rounded otherwise than the damage, in sums of terms that cancel and powers of them.
constexpr double rounded_up = 1. + 1e-9;

/// 1/constant is the largest of 1/N(range) / range^slope over the ranges that do damage.
UpperLine line_above(const SnCurve &curve, double slope)
{
  double largest = 0.;
  for (std::size_t j = 0; j < curve.pieces.size(); ++j)
    for (const double knee : {curve.pieces[j].from, j > 0 ? curve.pieces[j - 1].from : 0.})
      if (knee > 0.)
        largest = std::max(largest, curve.pieces[j].damage(knee) / std::pow(knee, slope));
  return {slope, 1. / largest};
}

/// docs/theory/life.md (9): lines of the pieces; where the curve is their minimum also lines through its knees, and
/// below a cut-off steeper ones.
std::vector<UpperLine> upper_lines(const SnCurve &curve, Miner miner)
{
  std::vector<UpperLine> lines;
  for (const SnPiece &piece : curve.pieces)
    lines.push_back({piece.slope, piece.constant});
  if (!curve.concave())
    return lines;
  for (std::size_t j = 1; j < curve.pieces.size(); ++j)
    if (curve.pieces[j].slope > curve.pieces[j - 1].slope)
      lines.push_back(line_above(curve, 0.5 * (curve.pieces[j - 1].slope + curve.pieces[j].slope)));
  const double q = curve.pieces.back().slope - 1.;
  if (miner == Miner::elementary || curve.cut_off() == 0. || q == 0.)
    return lines;
  for (const double more : {1., 3., 8.})
  {
    lines.push_back(line_above(curve, curve.pieces.back().slope + more));
    lines.back().constant /= miner == Miner::consequent ? 1. + more / q : 1.;
  }
  return lines;
}

/// (sum of count size^m)^(1/m).
class PowerSum
{
public:
  explicit PowerSum(const std::vector<SizeCount> &parts) : logarithm_(Index(parts.size())), count_(Index(parts.size()))
  {
    for (const SizeCount &part : parts)
      largest_ = std::max(largest_, part.size);
    for (std::size_t k = 0; k < parts.size(); ++k) // relative to the largest: powers do not overflow
    {
      logarithm_[Index(k)] = parts[k].size > 0. ? parts[k].size / largest_ : 1.;
      count_[Index(k)]     = parts[k].size > 0. ? parts[k].count : 0.;
    }
    logarithm_ = logarithm_.log();
  }

  double largest() const { return largest_; }
  double root(double m) const { return largest_ * std::pow((count_ * (m * logarithm_).exp()).sum(), 1. / m); }

private:
  double         largest_ = 0.;
  Eigen::ArrayXd logarithm_, count_;
};

/// Principal components of `centred` in the norm of `gram` [n x n], rounding in it added direction by direction, as in
/// coupling::largest_von_mises.
MatrixXd principal_basis(const MatrixXd &gram, const MatrixXd &centred, MatrixXd &components)
{
  const VectorXd scale = centred.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double z) { return z > 0. ? z : 1.; });
  const coupling::SymmetricEigenSolver norm(scale.asDiagonal() * gram * scale.asDiagonal());
  const VectorXd                       root   = norm.eigenvalues().cwiseMax(0.).cwiseSqrt();
  constexpr double                     noise  = 1e-6; // of the largest root, whose square is rounding of the norm
  Index                                hidden = 0;    // ascending
  while (hidden < root.size() && root[hidden] <= noise * root[root.size() - 1])
    ++hidden;
  const Index    n       = root.size() - hidden;
  const auto     vectors = norm.eigenvectors();
  const VectorXd inverse = scale.cwiseInverse();
  const MatrixXd whole =
      (root.tail(n).asDiagonal() * vectors.rightCols(n).transpose() * inverse.asDiagonal()) * centred;
  const coupling::SymmetricEigenSolver principal(whole * whole.transpose());
  const MatrixXd                       U = principal.eigenvectors();
  MatrixXd                             basis(root.size(), root.size());
  basis << vectors.rightCols(n) * root.tail(n).cwiseInverse().asDiagonal() * U, vectors.leftCols(hidden);
  components.resize(root.size(), centred.cols());
  components << U.transpose() * whole, vectors.leftCols(hidden).transpose() * (inverse.asDiagonal() * centred);
  return scale.asDiagonal() * basis;
}

} // namespace

DamageBounds::DamageBounds(const MatrixXd &states, const LoadSequence &load, const DamageRule &rule,
                           const MatrixXd &gram)
    : rule_(&rule), lines_(upper_lines(rule.curve, rule.miner)), least_(rule.curve.concave())
{
  mean_ = 0.5 * (states.rowwise().maxCoeff() + states.rowwise().minCoeff());
  MatrixXd       components;
  const MatrixXd centred = states.colwise() - mean_;
  basis_                 = principal_basis(gram, centred, components);
  largest_               = components.cwiseAbs().rowwise().maxCoeff().array();
  width_                 = (components.rowwise().maxCoeff() - components.rowwise().minCoeff()).array();
  measure(components, load);
  divide(components, load);
}

/// D_m(c_r)^(1/m) of every line.
void DamageBounds::measure(const MatrixXd &components, const LoadSequence &load)
{
  powers_ = MatrixXd::Zero(components.rows(), Index(lines_.size()));
  std::vector<Cycle> cycles;
  VectorXd           history;
  for (Index r = 0; r < components.rows(); ++r)
  {
    history = components.row(r);
    count_cycles(history.data(), load, cycles);
    std::vector<SizeCount> ranges;
    for (const Cycle &cycle : cycles)
      ranges.push_back({cycle.range, cycle.count});
    const PowerSum sum(ranges);
    for (Index j = 0; j < powers_.cols(); ++j)
      powers_(r, j) = sum.root(lines_[std::size_t(j)].slope);
  }
}

void DamageBounds::divide(const MatrixXd &components, const LoadSequence &load)
{
  constexpr std::int64_t window   = 32; // steps: fewer cost more, in more of them the components change more
  const auto             parts_of = [](const LoadBlock &samples, std::int64_t steps, std::vector<LoadBlock> &parts)
  {
    std::int64_t first = samples.first;
    do // a single sample is one, too
      parts.push_back({first, std::min(first + steps, samples.end), samples.repetitions});
    while ((first += steps) < samples.end);
  };
  for (const LoadBlock &block : load.blocks)
    parts_of({block.first, block.end - 1, block.repetitions}, window, windows_);
  middle_ = change_ = MatrixXd(components.rows(), Index(windows_.size()));
  for (Index w = 0; w < middle_.cols(); ++w)
  {
    const auto [first, last, repetitions] = windows_[std::size_t(w)];
    middle_.col(w)                        = components.col((first + last) / 2);
    const auto inside                     = components.middleCols(first, last - first + 1);
    change_.col(w)                        = (inside.colwise() - middle_.col(w)).cwiseAbs().rowwise().maxCoeff();
  }
  constexpr std::int64_t short_window = 8; // steps, a part of `window`
  for (const LoadBlock &whole : windows_)
    parts_of(whole, short_window, short_windows_);
  bend_ = MatrixXd::Zero(components.rows(), Index(short_windows_.size()));
  for (Index w = 0; w < bend_.cols(); ++w)
  {
    const auto [first, last, repetitions] = short_windows_[std::size_t(w)];
    for (std::int64_t t = first + 1; t < last; ++t)
    {
      const double part = double(t - first) / double(last - first);
      bend_.col(w)      = bend_.col(w).cwiseMax(
               (components.col(t) - (1. - part) * components.col(first) - part * components.col(last)).cwiseAbs());
    }
  }
}

VectorXd DamageBounds::bending(const Eigen::Ref<const Eigen::ArrayXd> &parts) const
{
  return rounded_up * (bend_.transpose() * parts.matrix());
}

std::vector<std::vector<LoadBlock>> DamageBounds::possible_sign_changes(const MatrixXd &parts, const VectorXd &offset,
                                                                        const VectorXd &margin) const
{
  const MatrixXd                      value  = ((parts * middle_).colwise() + offset).cwiseAbs();
  const MatrixXd                      change = (rounded_up * (parts.cwiseAbs() * change_)).colwise() + margin;
  std::vector<std::vector<LoadBlock>> possible(std::size_t(parts.rows()));
  for (Index w = 0; w < value.cols(); ++w)
    for (Index i = 0; i < value.rows(); ++i)
      if (value(i, w) <= change(i, w))
      {
        auto            &of_scalar = possible[std::size_t(i)];
        const LoadBlock &window    = windows_[std::size_t(w)];
        if (!of_scalar.empty() && of_scalar.back().end == window.first)
          of_scalar.back().end = window.end;
        else
          of_scalar.push_back(window);
      }
  return possible;
}

/// The least of (factor D_m^(1/m))^m / constant over the lines, or their sum.
template <typename Root>
double DamageBounds::of_roots(double factor, const Root &root) const
{
  double least = std::numeric_limits<double>::infinity(), sum = 0.;
  for (Index j = 0; j < powers_.cols(); ++j)
  {
    const double bound = std::pow(factor * root(j, lines_[std::size_t(j)].slope), lines_[std::size_t(j)].slope) /
                         lines_[std::size_t(j)].constant;
    least = std::min(least, bound);
    sum += bound;
  }
  return rounded_up * (least_ ? least : sum);
}

double DamageBounds::of_powers(const Eigen::Ref<const Eigen::ArrayXd> &parts, double factor,
                               const std::vector<SizeCount> &jumps) const
{
  const PowerSum of_jumps(jumps);
  return of_roots(factor,
                  [&](Index j, double m)
                  {
                    const double smooth = (parts * powers_.col(j).array()).sum();
                    return jumps.empty()
                               ? smooth
                               : std::pow(2., 1. - 1. / m) * smooth + std::pow(0.5, 1. / m) * of_jumps.root(m);
                  });
}

double DamageBounds::of_cycles(const std::vector<Cycle> &cycles, const std::vector<SizeCount> &remainder,
                               double peak) const
{
  std::vector<SizeCount> ranges;
  for (const Cycle &cycle : cycles)
    ranges.push_back({cycle.range, cycle.count});
  const PowerSum of_ranges(ranges), of_remainder(remainder);
  const double   factor = rule_->mean_stress.largest_factor(peak, rule_->curve.ratio);
  if (rule_->miner != Miner::elementary &&
      rounded_up * factor * (of_ranges.largest() + of_remainder.largest()) < rule_->curve.cut_off())
    return 0.;
  return of_roots(factor,
                  [&](Index, double m) { return of_ranges.root(m) + std::pow(0.5, 1. / m) * of_remainder.root(m); });
}

double DamageBounds::of_linear(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset) const
{
  const double factor = rule_->mean_stress.largest_factor(offset + (parts * largest_).sum(), rule_->curve.ratio);
  if (rule_->miner != Miner::elementary && rounded_up * factor * (parts * width_).sum() < rule_->curve.cut_off())
    return 0.;
  return of_powers(parts, factor, {});
}

double DamageBounds::peak_of_norm(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset) const
{
  return rounded_up * (offset + (parts * largest_).sum());
}

double DamageBounds::of_signed_norm(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset,
                                    const std::vector<SizeCount> &jumps) const
{
  const double peak   = peak_of_norm(parts, offset);
  const double factor = rule_->mean_stress.largest_factor(peak, rule_->curve.ratio);
  const double width  = jumps.empty() ? (parts * width_).sum() : 2. * peak;
  if (rule_->miner != Miner::elementary && rounded_up * factor * width < rule_->curve.cut_off())
    return 0.;
  return of_powers(parts, factor, jumps);
}

} // namespace gestell::apps
