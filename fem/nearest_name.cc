#include "fem/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace gestell::fem
{

namespace
{

/// Levenshtein's distance: letters to insert, delete or replace.
int edit_distance(const std::string &a, const std::string &b)
{
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    int diagonal = row[0];
    row[0]       = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal           = row[j];
      row[j]             = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

} // namespace

std::string nearest_names(const std::string &name, const std::vector<std::string> &known, const std::string &what)
{
  if (known.empty())
    return "it has no named " + what + " at all";

  std::vector<std::string> sorted; // each once: a solid in several pieces has the name of all
  for (const std::string &one : known)
    if (std::find(sorted.begin(), sorted.end(), one) == sorted.end())
      sorted.push_back(one);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const std::string &a, const std::string &b)
                   { return edit_distance(name, a) < edit_distance(name, b); });
  std::string text = "the nearest names are ";
  for (std::size_t i = 0; i < std::min<std::size_t>(3, sorted.size()); ++i)
    text += (i == 0 ? "\"" : ", \"") + sorted[i] + "\"";
  return text;
}

} // namespace gestell::fem
