#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

enum class Severity
{
  warning, ///< the result is valid, but perhaps not as intended
  error    ///< the result ends here, or is not physical
};

/// Result of a check, as a value.
struct Finding
{
  Severity    severity = Severity::warning;
  std::string id;    ///< kind of the finding, the same in all versions: "energy-balance"
  std::string place; ///< element, joint, switch, signal or key concerned; empty: the whole run
  std::string text;  ///< the problem, its location, and the remedy
};

inline std::vector<std::string> texts_of(const std::vector<Finding> &findings)
{
  std::vector<std::string> texts;
  for (const Finding &finding : findings)
    texts.push_back(finding.text);
  return texts;
}

/// End of a run, and its findings.
struct RunOutcome
{
  std::vector<Finding> findings; ///< except the one that ended it
  std::string          failure;  ///< not empty: reason for an early end
  std::string          end_id;   ///< kind of this end, as for a finding; empty: none
  std::string          end_place;
  bool                 interrupted = false;

  bool reached_end() const { return failure.empty() && !interrupted; }
  void warn(std::string id, std::string place, std::string text)
  {
    findings.push_back({Severity::warning, std::move(id), std::move(place), std::move(text)});
  }
  /// Only the first reason is stored.
  void stop(std::string id, std::string place, std::string text)
  {
    if (!failure.empty())
      return;
    failure   = std::move(text);
    end_id    = std::move(id);
    end_place = std::move(place);
  }
};

} // namespace gestell::coupling
