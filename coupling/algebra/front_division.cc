#include "coupling/algebra/front_division.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::coupling
{

namespace
{

std::vector<int> parents(const Fronts &fronts)
{
  std::vector<int> front_of(fronts.n, -1), parent(fronts.count, -1);
  for (int s = 0; s < fronts.count; ++s)
    std::fill(front_of.begin() + fronts.first[s], front_of.begin() + fronts.first[s + 1], s);
  for (int s = 0; s < fronts.count; ++s)
    if (const int below = fronts.begin[s] + fronts.first[s + 1] - fronts.first[s]; below < fronts.begin[s + 1])
      parent[s] = front_of[fronts.rows[below]];
  return parent;
}

/// Operations for a front: two factors (of C, and to count modes) and the ways through L.
double work_of(const Fronts &fronts, int s)
{
  const double     w = fronts.first[s + 1] - fronts.first[s], h = fronts.begin[s + 1] - fronts.begin[s], r = h - w;
  constexpr double swept = 600.; // operations per number of L in all solutions of a reduction, about
  return 2. * (w * w * w / 3. + w * w * r + w * r * r) + swept * w * h;
}

/// Subtrees dealt to ranks, the heaviest first to the one that has least; rank 0 ends with the least of all.
std::vector<int> dealt(const std::vector<std::pair<double, int>> &subtrees, int n_ranks, double &heaviest)
{
  std::vector<double> load(n_ranks, 0.);
  std::vector<int>    rank(subtrees.size());
  for (std::size_t k = 0; k < subtrees.size(); ++k)
  {
    rank[k] = int(std::min_element(load.begin(), load.end()) - load.begin());
    load[rank[k]] += subtrees[k].first;
  }
  const int lightest = int(std::min_element(load.begin(), load.end()) - load.begin());
  for (int &r : rank)
    r = r == lightest ? 0 : r == 0 ? lightest : r;
  heaviest = *std::max_element(load.begin(), load.end());
  return rank;
}

} // namespace

FrontDivision::FrontDivision(const Fronts &fronts, int n_ranks)
    : fronts_(fronts), parent_(parents(fronts)), rank_of_front_(fronts.count, -1)
{
  std::vector<double>                 subtree(fronts.count);
  std::vector<std::vector<int>>       children(fronts.count);
  std::vector<std::pair<double, int>> subtrees, best; // work and root, the heaviest first
  std::vector<int>                    best_rank;
  double                              all = 0., top = 0., least = INFINITY;
  for (int s = 0; s < fronts.count; ++s) // children come before
  {
    subtree[s] += work_of(fronts, s);
    if (parent_[s] < 0)
      subtrees.emplace_back(subtree[s], s), all += subtree[s];
    else
      subtree[parent_[s]] += subtree[s], children[parent_[s]].push_back(s);
  }
  for (;;)
  {
    std::sort(subtrees.rbegin(), subtrees.rend());
    double     heaviest = 0.;
    const auto rank     = dealt(subtrees, n_ranks, heaviest);
    if (top + heaviest < least)
      least = top + heaviest, best = subtrees, best_rank = rank;
    constexpr int    most_subtrees = 64;   // per rank: enough to even out their work
    constexpr double little        = 0.01; // of all work: subtrees that need no halving, as they fit between others
    if (subtrees.empty() || subtrees[0].first < little * all / n_ranks || top > least ||
        int(subtrees.size()) > most_subtrees * n_ranks)
      break;
    const int halved = subtrees[0].second;
    top += work_of(fronts, halved);
    subtrees.erase(subtrees.begin());
    for (const int child : children[halved])
      subtrees.emplace_back(subtree[child], child);
  }
  for (std::size_t k = 0; k < best.size(); ++k)
    rank_of_front_[best[k].second] = best_rank[k];
  for (int s = fronts.count - 1; s >= 0; --s) // the subtree of a root belongs to its rank
    if (rank_of_front_[s] < 0 && parent_[s] >= 0)
      rank_of_front_[s] = rank_of_front_[parent_[s]];
}

/// Passes on to the top.
bool FrontDivision::is_root(int front) const
{
  return rank_of_front_[front] >= 0 && parent_[front] >= 0 && rank_of_front_[parent_[front]] < 0;
}

/// Selects the fronts marked in `taken`; the columns of these ranks, in turn, become the first rows.
FrontSelection FrontDivision::selection(const std::vector<int> &columns_of_rank, const std::vector<char> &taken) const
{
  FrontSelection   selected;
  std::vector<int> row_of(fronts_.n, -1);
  for (const int rank : columns_of_rank)
    for (int s = 0; s < fronts_.count; ++s)
      for (int k = fronts_.first[s]; rank_of_front_[s] == rank && k < fronts_.first[s + 1]; ++k)
      {
        row_of[k] = int(selected.order.size());
        selected.order.push_back(fronts_.order[k]);
        selected.places.push_back(k);
      }
  for (int s = 0; s < fronts_.count; ++s)
  {
    if (!taken[s])
      continue;
    const int width = fronts_.first[s + 1] - fronts_.first[s];
    const int own   = rank_of_front_[s] == columns_of_rank.front() ? width : 0;
    for (int i = fronts_.begin[s] + width - own; i < fronts_.begin[s + 1]; ++i)
      selected.rows.push_back(row_of[fronts_.rows[i]]);
    selected.first.push_back(selected.first.back() + own);
    selected.begin.push_back(int(selected.rows.size()));
  }
  return selected;
}

FrontSelection FrontDivision::share(int rank) const
{
  std::vector<char> taken(fronts_.count);
  for (int s = 0; s < fronts_.count; ++s)
    taken[s] = rank_of_front_[s] == rank;
  return selection({rank, -1}, taken);
}

FrontSelection FrontDivision::top() const
{
  std::vector<char> taken(fronts_.count);
  for (int s = 0; s < fronts_.count; ++s)
    taken[s] = rank_of_front_[s] < 0 || is_root(s);
  return selection({-1}, taken);
}

std::vector<int> FrontDivision::givers() const
{
  std::vector<int> ranks;
  for (int s = 0; s < fronts_.count; ++s)
    if (is_root(s))
      ranks.push_back(rank_of_front_[s]);
  return ranks;
}

} // namespace gestell::coupling
