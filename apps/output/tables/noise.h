#pragma once

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// What tables for readers show as 0: a value below 1e-9 of the largest of its unit, which is what rounding leaves of
/// such sums.  Files keep it.
class Noise
{
public:
  /// Notes that a table has such a value.
  void see(const std::string &unit, double value);

  double without(const std::string &unit, double value) const;

private:
  std::map<std::string, double> largest_; ///< by unit
};

/// Of signals with `unit`, `min` and `max`.
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
