#pragma once

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Values that tables for people show as 0: those below 1e-9 of the largest value of the same unit, the size of
/// rounding errors in such sums.  Files contain them unchanged.
class Noise
{
public:
  /// Updates the largest value of this unit.
  void see(const std::string &unit, double value);

  double without(const std::string &unit, double value) const;

private:
  std::map<std::string, double> largest_; ///< by unit
};

/// Noise of signals with `unit`, `min` and `max`.
template <typename Signals>
Noise noise_of(const Signals &signals)
{
  Noise noise;
  for (const auto &signal : signals)
  {
    noise.see(signal.unit, signal.min);
    noise.see(signal.unit, signal.max);
  }
  return noise;
}

} // namespace gestell::apps
