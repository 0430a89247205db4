#include "coupling/modes/mode_tracking.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

Eigen::MatrixXd shapes(const std::vector<Mode> &modes, std::size_t count)
{
  Eigen::MatrixXd V(modes.empty() ? 0 : modes.front().shape.size(), Eigen::Index(count));
  for (std::size_t j = 0; j < count; ++j)
    V.col(Eigen::Index(j)) = modes[j].shape;
  return V;
}

bool same(const Mode &a, const Mode &b)
{
  // relative difference of frequencies below which shapes are an arbitrary mixture: the root of rounding
  constexpr double same_frequency = 1e-8;
  return std::abs(a.frequency_hz - b.frequency_hz) <= same_frequency * std::max(a.frequency_hz, b.frequency_hz);
}

/// Rotates the shapes of modes [begin, end) of one frequency towards the previous ones: V Q with the orthogonal Q that
/// minimises |V Q - V_before|, where V_before are as many shapes as contain most of them.
void turn_towards(const Eigen::MatrixXd &before, const Eigen::MatrixXd &M, std::vector<Mode> &modes, std::size_t begin,
                  std::size_t end)
{
  const auto      k = Eigen::Index(end - begin);
  Eigen::MatrixXd V(before.rows(), k);
  for (Eigen::Index j = 0; j < k; ++j)
    V.col(j) = modes[begin + std::size_t(j)].shape;
  const Eigen::MatrixXd overlap = V.transpose() * M * before; // [k x lines]
  std::vector<int>      order(std::size_t(before.cols()));
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = int(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return overlap.col(a).squaredNorm() > overlap.col(b).squaredNorm(); });
  order.resize(std::min(order.size(), std::size_t(k)));
  std::sort(order.begin(), order.end());
  Eigen::MatrixXd nearest = Eigen::MatrixXd::Zero(k, k);
  for (std::size_t j = 0; j < order.size(); ++j)
    nearest.col(Eigen::Index(j)) = overlap.col(order[j]);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(nearest, Eigen::ComputeFullU | Eigen::ComputeFullV);
  V = (V * svd.matrixU() * svd.matrixV().transpose()).eval();
  for (Eigen::Index j = 0; j < k; ++j)
    modes[begin + std::size_t(j)].shape = V.col(j);
}

void turn_mixtures(const Eigen::MatrixXd &before, const Eigen::MatrixXd &M, std::vector<Mode> &modes)
{
  for (std::size_t begin = 0, end; begin < modes.size(); begin = end)
  {
    for (end = begin + 1; end < modes.size() && same(modes[end - 1], modes[end]);)
      ++end;
    if (end - begin > 1)
      turn_towards(before, M, modes, begin, end);
  }
}

/// Sorts the modes of `next`, ascending, in the order of the lines of `before`.
void assign(const TrackedModes &before, TrackedModes &next, const Eigen::MatrixXd &M, std::size_t lines)
{
  const Eigen::MatrixXd V = shapes(before.modes, lines);
  turn_mixtures(V, M, next.modes);
  const Eigen::MatrixXd  overlap = V.transpose() * M * shapes(next.modes, next.modes.size());
  const Eigen::MatrixXd  value   = overlap.cwiseAbs2();
  const std::vector<int> chosen  = best_assignment(value);
  std::vector<bool>      taken(next.modes.size(), false);
  std::vector<Mode>      ordered;
  next.assurance.clear();
  for (std::size_t i = 0; i < lines; ++i)
  {
    const auto j = std::size_t(chosen[i]);
    taken[j]     = true;
    ordered.push_back(next.modes[j]);
    if (overlap(Eigen::Index(i), chosen[i]) < 0.)
      ordered.back().shape *= -1.;
    next.assurance.push_back(value(Eigen::Index(i), chosen[i]));
  }
  for (std::size_t j = 0; j < taken.size(); ++j)
    if (!taken[j])
      ordered.push_back(next.modes[j]);
  next.modes = std::move(ordered);
}

/// Whether two lines lie the other way round than before.
bool order_changes(const TrackedModes &before, const TrackedModes &next, std::size_t lines)
{
  for (std::size_t i = 0; i < lines; ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const Mode &a = before.modes[i], &b = before.modes[j], &c = next.modes[i], &d = next.modes[j];
      if (!same(a, b) && !same(c, d) && (a.frequency_hz > b.frequency_hz) != (c.frequency_hz > d.frequency_hz))
        return true;
    }
  return false;
}

class Tracking
{
public:
  Tracking(const Eigen::MatrixXd &M, const TrackingOptions &options, const std::function<std::vector<Mode>(double)> &at)
      : M_(M), options_(options), at_(at)
  {
  }

  void follow(const TrackedModes &before, TrackedModes &next, int halvings)
  {
    const std::vector<Mode> ascending = next.modes;
    const std::size_t       lines     = std::min({std::size_t(options_.lines), before.modes.size(), next.modes.size()});
    assign(before, next, M_, lines);
    const double least = next.assurance.empty() ? 1. : *std::min_element(next.assurance.begin(), next.assurance.end());
    if (least >= options_.sure && !order_changes(before, next, lines))
      return;
    if (halvings == options_.most_halving || between_ == options_.most_between)
      return;
    TrackedModes middle;
    middle.x = 0.5 * (before.x + next.x);
    ++between_;
    try
    {
      middle.modes = at_(middle.x);
    }
    catch (const std::invalid_argument &)
    {
      return;
    }
    catch (const ConvergenceFailure &)
    {
      return;
    }
    follow(before, middle, halvings + 1);
    next.modes = ascending;
    follow(middle, next, halvings + 1);
    for (std::size_t i = 0; i < std::min(next.assurance.size(), middle.assurance.size()); ++i)
      next.assurance[i] = std::min(next.assurance[i], middle.assurance[i]);
  }

private:
  const Eigen::MatrixXd                          &M_;
  const TrackingOptions                          &options_;
  const std::function<std::vector<Mode>(double)> &at_;
  int                                             between_ = 0;
};

} // namespace

// With potentials u of rows and v of columns: u_i + v_j <= cost_ij, equal where assigned; rows are added one by one
// along the cheapest path of exchanges.  Row and column 0 are none.
std::vector<int> best_assignment(const Eigen::MatrixXd &value)
{
  const int a = int(value.rows()), b = int(value.cols());
  if (a > b)
    throw std::invalid_argument("best_assignment: " + std::to_string(a) + " rows for " + std::to_string(b) +
                                " columns; give no more rows than columns");
  constexpr double    infinite = std::numeric_limits<double>::infinity();
  std::vector<double> u(a + 1, 0.), v(b + 1, 0.);
  std::vector<int>    row_of(b + 1, 0), way(b + 1, 0);
  for (int i = 1; i <= a; ++i)
  {
    std::vector<double> least(b + 1, infinite);
    std::vector<bool>   used(b + 1, false);
    int                 column = 0;
    row_of[0]                  = i;
    while (row_of[column] != 0)
    {
      used[column] = true;
      double delta = infinite;
      int    next  = 0;
      for (int j = 1; j <= b; ++j)
      {
        if (used[j])
          continue;
        const double slack = -value(row_of[column] - 1, j - 1) - u[row_of[column]] - v[j];
        if (slack < least[j])
        {
          least[j] = slack;
          way[j]   = column;
        }
        if (least[j] < delta)
        {
          delta = least[j];
          next  = j;
        }
      }
      for (int j = 0; j <= b; ++j)
        if (used[j])
        {
          u[row_of[j]] += delta;
          v[j] -= delta;
        }
        else
          least[j] -= delta;
      column = next;
    }
    for (; column != 0; column = way[column])
      row_of[column] = row_of[way[column]];
  }
  std::vector<int> column_of(a, -1);
  for (int j = 1; j <= b; ++j)
    if (row_of[j] != 0)
      column_of[row_of[j] - 1] = j - 1;
  return column_of;
}

void track(const TrackedModes &before, TrackedModes &next, const Eigen::MatrixXd &M, const TrackingOptions &options,
           const std::function<std::vector<Mode>(double)> &at)
{
  Tracking(M, options, at).follow(before, next, 0);
}

} // namespace gestell::coupling
