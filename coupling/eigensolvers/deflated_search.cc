#include "coupling/eigensolvers/deflated_search.h"

#include "coupling/integration/system/convergence_failure.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

namespace
{

constexpr int    beyond        = 4;    // modes that are looked for above those wanted, for a gap
constexpr double gap_for_shift = 1e-3; // relative distance of two frequencies that a shift may stand between

/// Both, in ascending order.
LowestModes joined(const LowestModes &a, const LowestModes &b)
{
  if (a.omega.size() == 0 || b.omega.size() == 0)
    return a.omega.size() == 0 ? b : a;
  const auto       n = a.V.rows(), m = a.omega.size() + b.omega.size();
  Eigen::VectorXd  omega(m), bound(m);
  Eigen::MatrixXd  V(n, m);
  std::vector<int> order(m);
  omega << a.omega, b.omega;
  bound << a.bound, b.bound;
  V << a.V, b.V;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return omega(i) < omega(j); });
  return {omega(order), V(Eigen::all, order), bound(order)};
}

} // namespace

DeflatedSearch::DeflatedSearch(int n, int n_free, Further further, LowestModes known)
    : n_free_(n_free), further_(std::move(further)), found_(std::move(known))
{
  if (found_.omega.size() == 0)
    found_ = {Eigen::VectorXd(0), Eigen::MatrixXd(n, 0), Eigen::VectorXd(0)};
}

void DeflatedSearch::find(int count)
{
  const int most = std::min(count + beyond, n_free_);
  while (int(found_.omega.size()) < most && !exhausted_)
  {
    const int wanted = most - int(found_.omega.size());
    auto      more   = further_(wanted, found_.V);
    exhausted_       = int(more.omega.size()) < wanted;
    found_           = joined(found_, more);
  }
  if (found_.omega.size() < count)
    throw ConvergenceFailure("lowest modes: " + std::to_string(found_.omega.size()) + " of " + std::to_string(count) +
                             " are found; ask for fewer modes: the mass matrix of the internal coordinates has no "
                             "higher rank, or a part is almost loose");
}

LowestModes DeflatedSearch::modes(int count) const
{
  if (count > found_.omega.size())
    throw std::logic_error("DeflatedSearch::modes: only " + std::to_string(found_.omega.size()) + " are found");
  return {found_.omega.head(count), found_.V.leftCols(count), found_.bound.head(count)};
}

/// Number of modes below the first gap that is wide enough, or else the widest.
int DeflatedSearch::gap_index(int count) const
{
  int    widest = count;
  double width  = 0.;
  for (int i = count; i < found_.omega.size(); ++i)
  {
    const double here = found_.omega(i) / found_.omega(i - 1) - 1.;
    if (here > width)
      widest = i, width = here;
    if (here > gap_for_shift)
      break;
  }
  return widest;
}

ModeSearch::Gap DeflatedSearch::gap_above(int count) const
{
  if (count > found_.omega.size())
    throw std::logic_error("DeflatedSearch: find() first");
  if (count == 0)
    return {0., found_.omega.size() > 0 ? found_.omega(0) : INFINITY, 0};
  const int i = gap_index(count);
  return {found_.omega(i - 1), i < found_.omega.size() ? found_.omega(i) : INFINITY, i};
}

} // namespace gestell::coupling
