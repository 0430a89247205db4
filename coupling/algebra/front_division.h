#pragma once

#include "coupling/algebra/multifrontal.h"

#include <vector>

namespace gestell::coupling
{

/// Some of the fronts of an elimination, with rows of their own numbering.
struct FrontSelection
{
  std::vector<int> first{0}, begin{0}, rows; // as Fronts
  std::vector<int> order, places;            // coordinate of every row, and its position in the whole elimination

  int    columns() const { return first.back(); }
  Fronts fronts() const
  {
    return {int(order.size()), int(begin.size()) - 1, first.data(), begin.data(), rows.data(), order.data()};
  }
};

/**
 * An elimination divided among ranks. Each has whole, independent subtrees of the fronts; their contributions go to the
 * fronts above, the top, which rank 0 eliminates last.
 */
class FrontDivision
{
public:
  /// Minimises the time of the slowest rank plus the top by halving the largest subtrees.
  FrontDivision(const Fronts &fronts, int n_ranks);

  /// The fronts of a rank: their columns, then all of the top.
  FrontSelection share(int rank) const;
  /// The fronts above, and one without columns for each front that contributes to them.
  FrontSelection top() const;
  /// For each front without columns: the rank that has its contribution.
  std::vector<int> givers() const;

private:
  bool           is_root(int front) const;
  FrontSelection selection(const std::vector<int> &columns_of_rank, const std::vector<char> &taken) const;

  Fronts           fronts_;
  std::vector<int> parent_, rank_of_front_; ///< rank -1: the top
};

} // namespace gestell::coupling
