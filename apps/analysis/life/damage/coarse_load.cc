#include "apps/analysis/life/damage/coarse_load.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{

double variation(const Eigen::Ref<const ArrayXd> &x)
{
  return (x.tail(x.size() - 1) - x.head(x.size() - 1)).abs().sum();
}

/// In one repetition of the load.
double variation(const Eigen::Ref<const ArrayXd> &x, const LoadSequence &load)
{
  double sum = 0.;
  for (std::size_t b = 0; b < load.blocks.size(); ++b)
  {
    const auto [first, end, repetitions] = load.blocks[b];
    sum += repetitions * (variation(x.segment(first, end - first)) + std::abs(x[first] - x[end - 1])) +
           std::abs(x[load.blocks[(b + 1) % load.blocks.size()].first] - x[end - 1]);
  }
  return sum;
}

/// Components minus the line between two samples [samples between x kept].
MatrixXd from_line(const Eigen::Ref<const MatrixXd> &c, std::int64_t first, std::int64_t last)
{
  const Index    n      = Index(last - first) - 1;
  const VectorXd part   = VectorXd::LinSpaced(n, 1., double(n)) / double(last - first);
  MatrixXd       inside = c.middleRows(first + 1, n).rowwise() - c.row(first);
  inside.noalias() -= part * (c.row(last) - c.row(first));
  return inside;
}

/// Divides each line between consecutive `samples` where its distance is largest, which is close to an extreme, until
/// it is at most `allowed`.
std::vector<std::int64_t> divided(const Eigen::Ref<const MatrixXd> &c, std::vector<std::int64_t> samples,
                                  double allowed)
{
  std::vector<std::int64_t> chosen, ends(samples.rbegin(), samples.rend());
  chosen.push_back(ends.back());
  ends.pop_back();
  while (!ends.empty())
  {
    Index at = 0;
    if (ends.back() - chosen.back() > 1 &&
        from_line(c, chosen.back(), ends.back()).rowwise().squaredNorm().maxCoeff(&at) > allowed * allowed)
      ends.push_back(chosen.back() + 1 + at);
    else
    {
      chosen.push_back(ends.back());
      ends.pop_back();
    }
  }
  return chosen;
}

} // namespace

CoarseLoad coarse_load(const coupling::PrincipalStates &states, const LoadSequence &load, double tolerance,
                       const CoarseLoad *coarser)
{
  const MatrixXd &c = states.components;
  CoarseLoad      coarse;
  coarse.load.residue = load.residue;
  coarse.largest      = c.cwiseAbs().colwise().maxCoeff().transpose();
  coarse.variation    = ArrayXd(c.cols());
  for (Index r = 0; r < c.cols(); ++r)
    coarse.variation[r] = variation(c.col(r), load);

  // the smallest components that together are half of the tolerance are left out
  const double allowed = tolerance * std::sqrt(c.leftCols(states.measured).rowwise().squaredNorm().maxCoeff());
  ArrayXd      left    = ArrayXd::Zero(c.rows()); // its square
  Index        kept    = states.measured;
  while (kept > 0)
  {
    const ArrayXd more = left + c.col(kept - 1).array().square();
    if (more.maxCoeff() > 0.25 * allowed * allowed)
      break;
    left = more;
    --kept;
  }
  coarse.largest.head(kept).setZero();
  coarse.variation.head(kept).setZero();

  std::vector<std::int64_t> &samples = coarse.samples;
  for (std::size_t b = 0; b < load.blocks.size(); ++b)
  {
    const auto [first, end, repetitions] = load.blocks[b];
    std::vector<std::int64_t> before{first};
    if (coarser)
      before.assign(coarser->samples.begin() + coarser->load.blocks[b].first,
                    coarser->samples.begin() + coarser->load.blocks[b].end);
    else if (end - 1 > first)
      before.push_back(end - 1);
    const auto chosen = divided(c.leftCols(kept), before, allowed);
    const auto begin  = std::int64_t(samples.size());
    samples.insert(samples.end(), chosen.begin(), chosen.end());
    coarse.load.blocks.push_back({begin, std::int64_t(samples.size()), repetitions});
  }

  coarse.components.resize(Index(samples.size()), kept);
  coarse.slope    = MatrixXd::Zero(c.cols(), Index(samples.size()));
  double distance = left.maxCoeff(); // its square
  for (const LoadBlock &block : coarse.load.blocks)
    for (Index i = Index(block.first); i < Index(block.end); ++i)
    {
      const std::int64_t first = samples[std::size_t(i)];
      coarse.components.row(i) = c.row(first).head(kept);
      if (i + 1 == Index(block.end))
        break;
      const std::int64_t last   = samples[std::size_t(i + 1)];
      const Index        n      = Index(last - first);
      MatrixXd           change = c.middleRows(first + 1, n) - c.middleRows(first, n);
      change.leftCols(kept).rowwise() -= (c.row(last) - c.row(first)).head(kept) / double(n);
      change              = change.cwiseAbs().eval();
      coarse.slope.col(i) = change.colwise().maxCoeff().transpose();
      coarse.variation.head(kept) += block.repetitions * change.leftCols(kept).colwise().sum().transpose().array();
      if (n == 1)
        continue;
      const MatrixXd inside = from_line(c.leftCols(kept), first, last);
      distance =
          std::max(distance, (inside.rowwise().squaredNorm().array() + left.segment(first + 1, n - 1)).maxCoeff());
      coarse.largest.head(kept) =
          coarse.largest.head(kept).max(inside.cwiseAbs().colwise().maxCoeff().transpose().array());
    }
  coarse.distance = std::sqrt(distance);
  return coarse;
}

} // namespace gestell::apps
