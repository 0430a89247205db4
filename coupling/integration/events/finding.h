#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

enum class Severity
{
  warning, ///< the result holds, but perhaps not as it was meant
  error    ///< the result ends here, or is not a motion of the machine
};

/// What a check found, as a value.
struct Finding
{
  Severity    severity = Severity::warning;
  std::string id;    ///< of the kind of finding, the same in all versions: "energy-balance"
  std::string place; ///< element, joint, switch, signal or key that it is about; empty: the run as a whole
  std::string text;  ///< what is wrong, where, and what to do
};

inline std::vector<std::string> texts_of(const std::vector<Finding> &findings)
{
  std::vector<std::string> texts;
  for (const Finding &finding : findings)
    texts.push_back(finding.text);
  return texts;
}

/// How a run ended and what was found of it.
struct RunOutcome
{
  std::vector<Finding> findings; ///< without the one that ended it
  std::string          failure;  ///< not empty: why it stopped early
  std::string          end_id;   ///< of the kind of this end, as of a finding; empty: of no kind
  std::string          end_place;
  bool                 interrupted = false;

  bool reached_end() const { return failure.empty() && !interrupted; }
  void warn(std::string id, std::string place, std::string text)
  {
    findings.push_back({Severity::warning, std::move(id), std::move(place), std::move(text)});
  }
  /// The first reason counts.
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
