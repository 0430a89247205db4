#include "coupling/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace gestell::coupling
{
namespace
{

std::string lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

} // namespace

int edit_distance(const std::string &a, const std::string &b)
{
  const int                     n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j)
    {
      if (i == 0 || j == 0)
      {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

std::string nearest_name(const std::string &name, const std::vector<std::string> &names)
{
  std::string best;
  int         best_distance = 1 << 20;
  for (const auto &candidate : names)
  {
    const int distance = edit_distance(lower(name), lower(candidate));
    // A third of the letters wrong is still a slip; more is another word.
    if (distance < best_distance && 3 * distance <= static_cast<int>(std::max(name.size(), candidate.size())) + 1)
    {
      best          = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string> &names)
{
  std::string text;
  for (const auto &name : names)
    text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

std::string suggestion(const std::string &name, const std::vector<std::string> &names)
{
  if (const auto nearest = nearest_name(name, names); !nearest.empty())
    return "; did you mean '" + nearest + "'?";
  return names.empty() ? "" : "; valid: " + listed(names);
}

} // namespace gestell::coupling
