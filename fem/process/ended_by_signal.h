#pragma once

namespace gestell::fem
{

/**
 * While this lives, signals that would end the process at once (SIGINT, SIGTERM, SIGHUP where nobody handles them) are
 * noted instead, so that children and temporary files can be removed before; of several in different threads the first
 * notes them.
 */
class EndedBySignal
{
public:
  EndedBySignal();
  ~EndedBySignal(); ///< obeys the signal that was noted, if there is one
  EndedBySignal(const EndedBySignal &)            = delete;
  EndedBySignal &operator=(const EndedBySignal &) = delete;

  bool requested() const;

private:
  static constexpr int n_signals        = 3;
  bool                 ours_[n_signals] = {};
};

} // namespace gestell::fem
