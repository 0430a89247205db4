#pragma once

namespace gestell::fem
{

/**
 * During its lifetime, signals that would end the process at once (SIGINT, SIGTERM, SIGHUP without a handler) are
 * recorded instead, so that children and temporary files can be removed first; with several instances in different
 * threads the first records them.
 */
class EndedBySignal
{
public:
  EndedBySignal();
  ~EndedBySignal(); ///< raises the recorded signal, if there is one
  EndedBySignal(const EndedBySignal &)            = delete;
  EndedBySignal &operator=(const EndedBySignal &) = delete;

  bool requested() const;

private:
  static constexpr int n_signals        = 3;
  bool                 ours_[n_signals] = {};
};

} // namespace gestell::fem
