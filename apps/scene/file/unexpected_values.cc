#include "apps/scene/file/unexpected_values.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{

constexpr std::size_t most_named = 5;

/// Without the line of the scene.
std::string key_of(const UnexpectedValue &value)
{
  const auto colon = value.place.rfind(": ");
  return colon == std::string::npos ? value.place : value.place.substr(colon + 2);
}

/// "; unexpected, too, perhaps by the same mistake: element.rod.damping, body.ram"
std::string others(const std::vector<UnexpectedValue> &values, const std::string &warning)
{
  std::vector<std::string> keys;
  for (const UnexpectedValue &value : values)
    if (const std::string key = key_of(value);
        warning.find(key) == std::string::npos && std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(key);
  std::string text;
  for (std::size_t i = 0; i < std::min(keys.size(), most_named); ++i)
    text += (text.empty() ? "; unexpected, too, perhaps by the same mistake: " : ", ") + keys[i];
  if (keys.size() > most_named)
    text += " and " + std::to_string(keys.size() - most_named) + " more";
  return text;
}

} // namespace

bool compares_magnitudes(const std::string &warning)
{
  return warning.find("; expected: ") != std::string::npos;
}

void warn_of_magnitudes(std::vector<UnexpectedValue> found, std::vector<std::string> &warnings)
{
  std::stable_sort(found.begin(), found.end(),
                   [](const UnexpectedValue &a, const UnexpectedValue &b) { return a.excess > b.excess; });
  auto cause = std::find_if(warnings.begin(), warnings.end(), compares_magnitudes);
  if (cause == warnings.end() && !found.empty())
    cause = warnings.insert(warnings.end(), found.front().place + ": " + found.front().words);
  if (cause != warnings.end())
    *cause += others(found, *cause);
}

} // namespace gestell::apps
