#pragma once

#include "coupling/frame/reduction_options.h"

#include <chrono>
#include <string>

namespace gestell::apps
{

/// "42 s", "3 min", "2 h": as exact as an estimate is.
std::string duration_text(double seconds);

/// Tells on standard error what is being done, one line that is drawn anew; silent if that is no terminal or `quiet`.
/// Behind two seconds of a phase it tells how long it took and, where a share of it is done, how long the rest of it
/// takes at that pace.
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

  std::string times(double share) const;

  bool              drawn_;
  std::string       phase_;
  Clock::time_point last_drawn_, begin_; ///< of the phase
  double            first_share_ = 0.;   ///< that was done when it was heard of first
};

} // namespace gestell::apps
