#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// Amplitudes of a signal at multiples of the speed of a rotor.
struct OrderedSignal
{
  std::string                      name, unit;
  std::vector<std::vector<double>> amplitudes; ///< by order, then by window
};

/// Signals of a run, sampled anew over the angle of a rotor and split into its orders.
struct OrderTracking
{
  std::string                rotor;
  int                        turns = 0;    ///< of a window
  std::vector<int>           orders;       ///< 1, 2, ...
  std::vector<double>        t, speed_rpm; ///< of the windows: their middle, and the mean speed [1/min]
  std::vector<OrderedSignal> signals;
};

} // namespace gestell::apps
