#pragma once

#include "coupling/frame/reduction_options.h"

#include <chrono>
#include <string>

namespace gestell::apps
{

/// Tells on standard error what is being done, one line that is drawn anew; silent if that is no terminal or `quiet`.
class ProgressLine
{
public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine &) = delete;

  /// A phase begins or goes on; share 0..1 of it is done, negative: unknown.
  void show(const std::string &phase, double share = -1.);
  /// Clears the line.
  void done();

  /// show(), for what computes; this must outlive it.
  coupling::Progress callback();

private:
  using Clock = std::chrono::steady_clock;

  bool              drawn_;
  std::string       phase_;
  Clock::time_point last_drawn_;
};

} // namespace gestell::apps
