#pragma once

#include <cmath>
#include <cstdint>

namespace gestell::tests
{

/// Random numbers that are the same on every machine: splitmix64 (Steele, Lea, Flood 2014), no distribution of a
/// library.
class Dice
{
public:
  explicit Dice(std::uint64_t seed) : state_(seed) { next(); }

  std::uint64_t next()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z               = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  double share() { return double(next() >> 11) * 0x1p-53; } ///< in [0, 1)
  double between(double a, double b) { return a + (b - a) * share(); }
  double log_between(double a, double b) { return a * std::pow(b / a, share()); }
  /// 0 ... n - 1
  int    whole(int n) { return int(next() % std::uint64_t(n)); }
  bool   chance(double p) { return share() < p; }
  double sign() { return chance(0.5) ? 1. : -1.; }

private:
  std::uint64_t state_;
};

} // namespace gestell::tests
