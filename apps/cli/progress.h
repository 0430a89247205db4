#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Tells on standard error what is being done, one line that is drawn anew; silent if that is no terminal or `quiet`.
/// Keeps the wall time of every phase.
class ProgressLine
{
public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();

  /// A phase begins or goes on; share 0..1 of it is done, negative: unknown.
  void show(const std::string &phase, double share = -1.);
  /// Ends the current phase and clears the line.
  void done();

  const std::vector<std::pair<std::string, double>> &wall_seconds() const { return phases_; }

private:
  using Clock = std::chrono::steady_clock;

  void end_phase();

  bool                                        drawn_;
  std::string                                 phase_;
  Clock::time_point                           begin_, last_drawn_;
  std::vector<std::pair<std::string, double>> phases_;
};

} // namespace gestell::apps
