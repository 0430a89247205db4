#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Wall time of every phase of a computation.
class PhaseTimes
{
public:
  void begin(const std::string &phase); ///< starts or continues a phase
  void end();                           ///< ends the current one

  const std::vector<std::pair<std::string, double>> &seconds() const { return phases_; }

private:
  using Clock = std::chrono::steady_clock;

  std::string                                 phase_;
  Clock::time_point                           begin_;
  std::vector<std::pair<std::string, double>> phases_;
};

} // namespace gestell::apps
