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

/// Spectra of a signal at rising speeds of a rotor.
struct Waterfall
{
  std::string                      name, unit;
  std::vector<double>              frequencies_hz, speed_rpm; ///< of the columns, of the rows [1/min]
  std::vector<std::vector<double>> amplitudes;                ///< by speed, then by frequency
};

/// Signals of a run, sampled anew over the angle of a rotor and split into its orders.
struct OrderTracking
{
  std::string                rotor;
  int                        turns = 0;    ///< of a window
  std::vector<int>           orders;       ///< 1, 2, ...
  std::vector<double>        t, speed_rpm; ///< of the windows: their middle, and the mean speed [1/min]
  std::vector<OrderedSignal> signals;
  std::vector<Waterfall>     waterfalls; ///< of the same signals, where the speed changes
};

} // namespace gestell::apps
