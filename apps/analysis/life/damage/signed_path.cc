#include "apps/analysis/life/damage/signed_path.h"

#include "apps/analysis/life/damage/stress_measure.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

using Eigen::ArrayXd;
using Eigen::Index;

/// |V| along a line between two samples, part 0 to 1.
struct NormOnLine
{
  double begin, product, end; ///< V.V, V.V', V'.V'

  double at(double part) const
  {
    const double rest = 1. - part;
    return std::sqrt(std::max(0., rest * rest * begin + 2. * rest * part * product + part * part * end));
  }
  double length() const { return std::sqrt(std::max(0., begin - 2. * product + end)); }
  /// Part of the smallest |V|; negative: none inside.
  double smallest() const
  {
    return product < begin && product < end ? (begin - product) / (begin - 2. * product + end) : -1.;
  }
};

/// Adds the values of a block one after another.
class PathOfBlock
{
public:
  PathOfBlock(SignedPath &path, double repetitions, double error)
      : path_(path), repetitions_(repetitions), error_(error)
  {
  }

  void certain(int sign, double norm)
  {
    if (open_)
      close(sign);
    path_.history.push_back(sign * norm);
    sign_ = sign;
  }

  /// |V| goes from `begin` to `end`, with a sign that changes at most `changes` times; `steady` 1 or -1: at most once
  /// together with neighbours of this direction.
  void uncertain(double begin, double end, bool falls_first, double changes, int steady)
  {
    open_ = true;
    changes_ += steady == 0 ? changes : steady != steady_ ? 1. : 0.;
    steady_ = steady;
    if (begin != end || falls_first)
    {
      minima_ += falls_first || (falling_ && end > begin) ? 1. : 0.;
      falling_ = end < begin && !falls_first;
    }
    largest_ = std::max({largest_, begin, end});
  }

  void end()
  {
    if (open_)
      close(0);
  }

private:
  void close(int next)
  {
    const int before = sign_ ? sign_ : next ? -next : -1;
    const int after  = next ? next : -before;
    double    more   = minima_;
    path_.history.push_back(before * largest_);
    path_.history.push_back(-before * largest_);
    if (before == after)
    {
      path_.history.push_back(after * largest_);
      more += std::floor(0.5 * std::max(0., changes_ - 2.));
    }
    else
      more += std::floor(0.5 * std::max(0., changes_ - (sign_ && next ? 1. : sign_ || next ? 0. : -1.)));
    if (more > 0.)
      path_.flips.push_back({2. * largest_, 0., repetitions_ * more, 0, 0});
    path_.variation += 2. * repetitions_ * error_;
    open_ = falling_ = false;
    steady_          = 0;
    changes_ = minima_ = largest_ = 0.;
  }

  SignedPath &path_;
  double      repetitions_, error_;
  int         sign_ = 0; ///< 0: not yet known
  bool        open_ = false, falling_ = false;
  int         steady_  = 0;
  double      changes_ = 0., minima_ = 0., largest_ = 0.;
};

} // namespace

void signed_path(const SignedHistory &of, const CoarseLoad &load, SignedPath &path)
{
  path.history.clear();
  path.load.blocks.clear();
  path.load.residue = load.load.residue;
  path.flips.clear();
  path.variation       = 0.;
  const Index   n      = of.V.rows();
  const ArrayXd square = of.V.rowwise().squaredNorm(), norm = square.sqrt();
  const ArrayXd product = of.V.topRows(n - 1).cwiseProduct(of.V.bottomRows(n - 1)).rowwise().sum();
  const auto sign = [&](Index i) { return of.trace[i] > of.trace_error ? 1 : of.trace[i] < -of.trace_error ? -1 : 0; };
  for (const LoadBlock &block : load.load.blocks)
  {
    const auto  begin = std::int64_t(path.history.size());
    PathOfBlock of_block(path, block.repetitions, of.error);
    int         here = sign(Index(block.first));
    if (here != 0)
      of_block.certain(here, norm[block.first]);
    else
      of_block.uncertain(norm[block.first], norm[block.first], false, 0., 0);
    for (Index i = Index(block.first); i + 1 < Index(block.end); ++i)
    {
      const int        next  = sign(i + 1);
      const double     steps = double(load.samples[std::size_t(i + 1)] - load.samples[std::size_t(i)]);
      const NormOnLine line{square[i], product[i], square[i + 1]};
      const double     smallest = line.smallest(), length = line.length();
      if (here != 0 && here == next)
      {
        double change = std::abs(norm[i + 1] - norm[i]);
        if (smallest > 0.)
        {
          const double least = line.at(smallest);
          of_block.certain(here, least);
          change = norm[i] + norm[i + 1] - 2. * least;
        }
        of_block.certain(next, norm[i + 1]);
        path.variation += block.repetitions * std::max(0., length - change);
        continue;
      }
      // within a part of the line the trace is within its error
      const double rise = of.trace[i + 1] - of.trace[i];
      const double from = here != 0 ? (std::abs(of.trace[i]) - of.trace_error) / std::abs(rise) : 0.;
      const double to   = next != 0 ? 1. - (std::abs(of.trace[i + 1]) - of.trace_error) / std::abs(rise) : 1.;
      if (here != 0)
      {
        if (smallest > 0. && smallest < from)
          of_block.certain(here, line.at(smallest));
        of_block.certain(here, line.at(from));
      }
      const bool   steady = std::abs(rise) - trace_of_rounding * length > steps * of.trace_parts.dot(load.slope.col(i));
      const double changes = std::min(steps, std::floor((to - from) * steps + 1e-6) + 2.);
      of_block.uncertain(line.at(from), line.at(to), smallest > from && smallest < to, changes,
                         !steady     ? 0
                         : rise > 0. ? 1
                                     : -1);
      if (next != 0)
      {
        of_block.certain(next, line.at(to));
        if (smallest > to)
          of_block.certain(next, line.at(smallest));
        of_block.certain(next, norm[i + 1]);
      }
      path.variation += block.repetitions * length;
      here = next;
    }
    of_block.end();
    path.load.blocks.push_back({begin, std::int64_t(path.history.size()), block.repetitions});
  }
}

} // namespace gestell::apps
