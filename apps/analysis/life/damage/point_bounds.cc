#include "apps/analysis/life/damage/point_bounds.h"

#include <cmath>

namespace gestell::apps
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{

constexpr Index points_of_bounds = 256; // multiplied together

MatrixXd stress_gram(const PointStresses &stresses, const std::vector<int> &points)
{
  const Index n   = stresses.states().rows();
  MatrixXd    sum = MatrixXd::Zero(n, n);
  in_blocks_of(points_of_bounds, points,
               [&](const std::vector<int> &some)
               {
                 const MatrixXd S = stresses.matrices(some);
                 sum.noalias() += S.transpose() * S;
               });
  return sum;
}

} // namespace

PointBounds::PointBounds(const PointStresses &stresses, const std::vector<int> &points)
    : stresses_(stresses), bounds_(stresses.states(), stresses.load(), stresses.rule(), stress_gram(stresses, points))
{
  if (!stresses.is_signed())
    return;
  std::vector<std::int64_t> samples; // windows of a block share their borders
  for (const LoadBlock &window : bounds_.short_windows())
  {
    if (samples.empty() || samples.back() != window.first)
      samples.push_back(window.first);
    border_.push_back(Index(samples.size()) - 1);
    samples.push_back(window.end);
  }
  borders_.resize(stresses.states().rows(), Index(samples.size()));
  for (Index k = 0; k < borders_.cols(); ++k)
    borders_.col(k) = stresses.states().col(samples[std::size_t(k)]);
}

std::vector<PointBounds::SignedParts> PointBounds::signed_parts(const MatrixXd &S) const
{
  const Index              n      = S.rows() / 6;
  const MatrixXd           parts  = S * bounds_.basis();
  const VectorXd           offset = S * bounds_.mean();
  MatrixXd                 trace(n, parts.cols());
  VectorXd                 trace_offset(n), margin(n);
  std::vector<SignedParts> result(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i)
  {
    SignedParts &of_point = result[std::size_t(i)];
    of_point.norms        = (von_mises_norm() * parts.middleRows<6>(6 * i)).colwise().norm().transpose().array();
    of_point.offset       = (von_mises_norm() * offset.segment<6>(6 * i)).norm();
    of_point.peak         = bounds_.peak_of_norm(of_point.norms, of_point.offset);
    trace.row(i)          = trace_row() * parts.middleRows<6>(6 * i);
    trace_offset[i]       = trace_row() * offset.segment<6>(6 * i);
    margin[i]             = trace_of_rounding * of_point.peak;
  }
  auto within = bounds_.possible_sign_changes(trace, trace_offset, margin);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i].within = std::move(within[i]);
  return result;
}

VectorXd PointBounds::of_points(const std::vector<int> &points) const
{
  VectorXd bound(points.size());
  in_blocks_of(points_of_bounds, points,
               [&, first = Index(0)](const std::vector<int> &some) mutable
               {
                 const MatrixXd S = stresses_.matrices(some);
                 if (stresses_.is_signed())
                 {
                   const auto parts = signed_parts(S);
                   for (std::size_t i = 0; i < some.size(); ++i)
                     bound[first++] = bounds_.of_signed_norm(
                         parts[i].norms, parts[i].offset,
                         stresses_.sign_jumps(S.middleRows<6>(6 * Index(i)), parts[i].within, parts[i].peak));
                   return;
                 }
                 const MatrixXd parts  = S * bounds_.basis();
                 const VectorXd offset = S * bounds_.mean();
                 for (std::size_t i = 0; i < some.size(); ++i)
                   bound[first++] = of_rows(stresses_.rows(some[i]), parts.middleRows<6>(6 * Index(i)),
                                            offset.segment<6>(6 * Index(i)))
                                        .maxCoeff();
               });
  return bound;
}

VectorXd PointBounds::of_rows(const MeasureRows &rows, const MatrixXd &S) const
{
  return of_rows(rows, S * bounds_.basis(), S * bounds_.mean());
}

VectorXd PointBounds::of_rows(const MeasureRows &rows, const PointStress &parts, const coupling::Stress &offset) const
{
  const MatrixXd norms = (rows * parts).cwiseAbs();
  VectorXd       bound(rows.rows());
  for (Index i = 0; i < rows.rows(); ++i)
    bound[i] = bounds_.of_linear(norms.row(i).transpose().array(), rows.row(i) * offset);
  return bound;
}

VectorXd PointBounds::of_samples(const std::vector<int> &points) const
{
  const MatrixXd S     = stresses_.matrices(points);
  const MatrixXd sigma = borders_.transpose() * S.transpose();
  const auto     parts = signed_parts(S);
  VectorXd       bound(points.size());
  for (Index i = 0; i < bound.size(); ++i)
    bound[i] = of_samples(parts[std::size_t(i)], S.middleRows<6>(6 * i), sigma.middleCols<6>(6 * i));
  return bound;
}

double PointBounds::of_samples(const SignedParts &parts, const PointStress &S, const MatrixXd &sigma) const
{
  const VectorXd border  = signed_history(sigma);
  const VectorXd bending = bounds_.bending(parts.norms);
  const auto    &windows = bounds_.short_windows();

  // all samples where the sign may change, elsewhere the borders of short windows
  LoadSequence           load{{}, stresses_.load().residue};
  std::vector<double>    history;
  std::vector<SizeCount> remainder;
  VectorXd               inside;
  auto                   run = parts.within.begin();
  for (std::size_t w = 0; w < windows.size(); ++w)
  {
    const LoadBlock &window = windows[w];
    const Index      first = border_[w], end = first + 1;
    if (w == 0 || windows[w - 1].end != window.first) // of a block
    {
      load.blocks.push_back({std::int64_t(history.size()), 0, window.repetitions});
      history.push_back(border[first]);
    }
    while (run != parts.within.end() && run->end <= window.first)
      inside.resize(0), ++run;
    if (run != parts.within.end() && run->first <= window.first)
    {
      if (inside.size() == 0)
        inside = signed_history(stresses_.states().middleCols(run->first, run->end - run->first + 1).transpose() *
                                S.transpose());
      history.insert(history.end(), inside.data() + (window.first + 1 - run->first),
                     inside.data() + (window.end + 1 - run->first));
    }
    else
    {
      const double arc = std::abs(border[first]) + std::abs(border[end]) -
                         coupling::von_mises((sigma.row(first) + sigma.row(end)).transpose());
      history.push_back(border[end]);
      remainder.push_back(
          {2. * (bending[Index(w)] + std::max(0., arc)), 2. * window.repetitions * double(window.end - window.first)});
    }
    load.blocks.back().end = std::int64_t(history.size());
  }
  std::vector<Cycle> cycles;
  count_cycles(history.data(), load, cycles);
  return bounds_.of_cycles(cycles, remainder, parts.peak);
}

} // namespace gestell::apps
