#include "apps/analysis/life/damage_bounds.h"

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
    Eigen::ArrayXd range(cycles.size()), count(cycles.size());
    for (std::size_t k = 0; k < cycles.size(); ++k)
    {
      range[Index(k)] = cycles[k].range / width_[r]; // whose powers do not overflow
      count[Index(k)] = cycles[k].count;
    }
    range = range.log();
    for (Index j = 0; j < powers_.cols() && !cycles.empty(); ++j)
    {
      const double m = lines_[std::size_t(j)].slope;
      powers_(r, j)  = width_[r] * std::pow((count * (m * range).exp()).sum(), 1. / m);
    }
  }
}

void DamageBounds::divide(const MatrixXd &components, const LoadSequence &load)
{
  constexpr std::int64_t window = 32; // steps: fewer cost more, in more of them the components change more
  for (const LoadBlock &block : load.blocks)
    for (std::int64_t first = block.first; first < block.end - 1; first += window)
      windows_.push_back({first, std::min(first + window, block.end - 1), block.repetitions});
  middle_ = change_ = MatrixXd(components.rows(), Index(windows_.size()));
  for (Index w = 0; w < middle_.cols(); ++w)
  {
    const auto [first, last, repetitions] = windows_[std::size_t(w)];
    middle_.col(w)                        = components.col((first + last) / 2);
    const auto inside                     = components.middleCols(first, last - first + 1);
    change_.col(w)                        = (inside.colwise() - middle_.col(w)).cwiseAbs().rowwise().maxCoeff();
  }
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

double DamageBounds::of_powers(const Eigen::Ref<const Eigen::ArrayXd> &parts, double factor,
                               const std::vector<SignJump> &jumps) const
{
  double least = std::numeric_limits<double>::infinity(), sum = 0.;
  for (Index j = 0; j < powers_.cols(); ++j)
  {
    const auto &[m, constant] = lines_[std::size_t(j)];
    double root               = (parts * powers_.col(j).array()).sum();
    if (!jumps.empty())
    {
      double damage = 0.;
      for (const SignJump &jump : jumps)
        damage += 0.5 * jump.count * std::pow(jump.size, m);
      root = std::pow(2., 1. - 1. / m) * root + std::pow(damage, 1. / m);
    }
    const double bound = std::pow(factor * root, m) / constant;
    least              = std::min(least, bound);
    sum += bound;
  }
  return rounded_up * (least_ ? least : sum);
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
                                    const std::vector<SignJump> &jumps) const
{
  const double peak   = peak_of_norm(parts, offset);
  const double factor = rule_->mean_stress.largest_factor(peak, rule_->curve.ratio);
  const double width  = jumps.empty() ? (parts * width_).sum() : 2. * peak;
  if (rule_->miner != Miner::elementary && rounded_up * factor * width < rule_->curve.cut_off())
    return 0.;
  return of_powers(parts, factor, jumps);
}

} // namespace gestell::apps
