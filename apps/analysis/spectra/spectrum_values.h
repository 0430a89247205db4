#pragma once

#include "apps/output/values/answer.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Amplitudes of a signal at the frequencies k / T of a window of length T.
struct SignalSpectrum
{
  std::string         name, unit;
  std::vector<double> amplitudes; ///< at frequency k times the resolution, k = 0, 1, ...
};

/// Spectra of signals over a run, with one Hann window.
struct Spectra
{
  double                      begin = 0., end = 0.; ///< [s] of the window
  int                         samples       = 0;
  double                      resolution_hz = 0.; ///< 1 / (end - begin); the half-width of a spectral line
  double                      row_step      = 0.; ///< [s] between the rows
  double                      carried_hz    = 0.; ///< highest frequency resolved by the rows; faster motion is aliased
  std::vector<SignalSpectrum> signals;
};

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
  std::vector<double>              frequencies_hz, speed_rpm; ///< of the columns; of the rows [1/min]
  std::vector<std::vector<double>> amplitudes;                ///< by speed, then by frequency
};

/// Signals of a run, resampled over the angle of a rotor and split into its orders.
struct OrderTracking
{
  std::string                rotor;
  int                        turns = 0;    ///< revolutions per window
  std::vector<int>           orders;       ///< 1, 2, ...
  std::vector<double>        t, speed_rpm; ///< of the windows: their middle, and the mean speed [1/min]
  std::vector<OrderedSignal> signals;
  std::vector<Waterfall>     waterfalls; ///< of the same signals, if the speed changes
};

/// Spectra of a run: over time, and over the angle of a rotor.
struct RunSpectra
{
  std::optional<Spectra>       spectra;
  std::optional<OrderTracking> orders;
};

template <class Visitor>
void describe_answer(Visitor &, const RunSpectra &)
{
  // too many numbers for summary.json
}

Section order_section(const Result &result, const OrderTracking &tracking);
Section spectrum_section(const Result &result, const RunSpectra &found);

} // namespace gestell::apps
