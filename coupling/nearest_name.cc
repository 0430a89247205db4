#include "coupling/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace gestell::coupling
{

namespace
{
// Levenshtein's distance, one row at a time.
int edit_distance(const std::string &a, const std::string &b)
{
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    int diagonal = row[0];
    row[0]       = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal           = row[j + 1];
      row[j + 1]         = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}
} // namespace

std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates)
{
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(),
                       [&](const auto &a, const auto &b) { return edit_distance(name, a) < edit_distance(name, b); });
  return nearest == candidates.end() ? std::string() : *nearest;
}

} // namespace gestell::coupling
