#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

namespace gestell
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

namespace
{

std::vector<std::string> parts_of(const std::string &path)
{
  std::vector<std::string> parts(1);
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

constexpr int another_word = 1 << 20; ///< more than any distance of two words

/// Edit distance of a typing error; `another_word` if the words differ by more than a third of their letters.
int slip(const std::string &name, const std::string &meant)
{
  constexpr std::size_t longest_word = 200; // bounds time and memory, which grow with the product of the lengths
  if (std::max(name.size(), meant.size()) > longest_word)
    return another_word;
  const int distance = edit_distance(lower(name), lower(meant));
  return 3 * distance <= static_cast<int>(std::max(name.size(), meant.size())) + 1 ? distance : another_word;
}

/// The same for a path of which a name without dots may be one part: "guide" for "frame.guide". Whole names rank first.
int slip_of_path(const std::string &name, const std::string &path)
{
  int smallest = 2 * slip(name, path);
  if (const auto parts = parts_of(path); parts.size() > 1 && name.find('.') == std::string::npos)
    for (const std::string &part : parts)
      smallest = std::min(smallest, 2 * slip(name, part) + 1);
  return smallest;
}

std::vector<std::string> sorted_by(const std::vector<std::string>                     &names,
                                   const std::function<int(const std::string &meant)> &distance)
{
  std::vector<std::pair<int, std::string>> sorted;
  for (const auto &candidate : names)
    sorted.emplace_back(distance(candidate), candidate);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  std::vector<std::string> result;
  for (auto &[d, candidate] : sorted)
    if (d < another_word)
      result.push_back(std::move(candidate));
  return result;
}

} // namespace

std::vector<std::string> near_names(const std::string &name, const std::vector<std::string> &names)
{
  return sorted_by(names, [&](const std::string &meant) { return slip_of_path(name, meant); });
}

std::string nearest_name(const std::string &name, const std::vector<std::string> &names)
{
  const auto near = near_names(name, names);
  return near.empty() ? "" : near.front();
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
  constexpr std::size_t few = 5, readable = 40; // names of a message
  auto                  near = near_names(name, names);
  if (!near.empty())
  {
    const int best = slip_of_path(name, near.front());
    near.erase(std::find_if(near.begin(), near.end(), [&](const auto &n) { return slip_of_path(name, n) > best; }),
               near.end());
    near.resize(std::min(near.size(), few));
    return near.size() == 1 ? "; did you mean '" + near.front() + "'?" : "; did you mean one of " + listed(near) + "?";
  }
  if (names.size() <= readable)
    return names.empty() ? "" : "; valid: " + listed(names);
  auto nearest = sorted_by(names, [&](const std::string &meant) { return edit_distance(lower(name), lower(meant)); });
  nearest.resize(few);
  return "; the nearest of " + std::to_string(names.size()) + " are " + listed(nearest);
}

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

} // namespace gestell
