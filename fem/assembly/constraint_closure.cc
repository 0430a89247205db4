#include "fem/assembly/constraint_closure.h"

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/// Visits what a tie leads to, depth first; `state`: 1 while a tie is followed, 2 once it is known to end.
void require_end(int tie, const std::vector<int> &tie_of, const std::vector<Combination> &ties,
                 std::vector<char> &state)
{
  state[tie] = 1;
  for (const auto &[value, weight] : ties[tie])
  {
    const int next = value < static_cast<int>(tie_of.size()) ? tie_of[value] : -1;
    if (next >= 0 && state[next] == 1)
      throw std::invalid_argument("constraints: displacement " + std::to_string(value) +
                                  " is tied to itself through other displacements");
    if (next >= 0 && state[next] == 0)
      require_end(next, tie_of, ties, state);
  }
  state[tie] = 2;
}

/// Whether no value of the combination is fixed or tied.
bool ends_free(const Combination &tie, const std::vector<char> &held, const std::vector<int> &tie_of)
{
  return std::none_of(tie.begin(), tie.end(),
                      [&](const auto &entry)
                      {
                        const std::size_t value = std::size_t(entry.first);
                        return value < held.size() && (held[value] != 0 || tie_of[value] >= 0);
                      });
}

} // namespace

std::vector<Combination> closed_ties(const std::vector<char> &held, const std::vector<int> &tie_of,
                                     const std::vector<Combination> &ties)
{
  std::vector<char> state(ties.size(), 0);
  for (std::size_t tie = 0; tie < ties.size(); ++tie)
    if (state[tie] == 0)
      require_end(static_cast<int>(tie), tie_of, ties, state);

  if (std::all_of(ties.begin(), ties.end(), [&](const Combination &tie) { return ends_free(tie, held, tie_of); }))
    return ties;
  dealii::AffineConstraints<double> constraints;
  for (std::size_t i = 0; i < tie_of.size(); ++i)
    if (tie_of[i] >= 0)
    {
      constraints.add_line(i);
      for (const auto &[value, weight] : ties[tie_of[i]])
        constraints.add_entry(i, value, weight);
    }
    else if (held[i])
      constraints.add_line(i);
  constraints.close();

  std::vector<Combination> closed = ties; // in their own order where nothing is put in
  for (std::size_t i = 0; i < tie_of.size(); ++i)
    if (tie_of[i] >= 0 && !ends_free(ties[tie_of[i]], held, tie_of))
    {
      closed[tie_of[i]].clear();
      for (const auto &[value, weight] : *constraints.get_constraint_entries(i))
        closed[tie_of[i]].emplace_back(static_cast<int>(value), weight);
    }
  return closed;
}

} // namespace gestell::fem
