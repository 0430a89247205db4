#pragma once

#include "coupling/frame/reduction_options.h"

#include <chrono>
#include <string>

namespace gestell::apps
{

/// "42 s", "3 min", "2 h": with the precision of an estimate.
std::string duration_text(double seconds);

/// Shows the current phase on standard error in one line that is updated; silent if that is not a terminal, or with
/// `quiet`.  After two seconds of a phase the line shows the time elapsed and, if the completed share is known, the
/// estimated time that remains.
class ProgressLine
{
public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine &) = delete;

  /// A phase begins or continues; `share` is the completed part from 0 to 1, negative: unknown.
  void show(const std::string &phase, double share = -1.);
  /// Clears the line.
  void done();

  /// show() as a callback for computations; this object must outlive it.
  coupling::Progress callback();

private:
  using Clock = std::chrono::steady_clock;

  std::string times(double share) const;

  bool              drawn_;
  std::string       phase_;
  Clock::time_point last_drawn_, begin_; ///< of the phase
  double            first_share_ = 0.;   ///< completed share at the first call in the phase
};

} // namespace gestell::apps
