#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// Amplitudes of a signal at the frequencies k / T of a window of length T.
struct SignalSpectrum
{
  std::string         name, unit;
  std::vector<double> amplitudes; ///< of frequency k times the resolution, k = 0, 1, ...
};

/// Spectra of signals over a run, in one window after Hann.
struct Spectra
{
  double                      begin = 0., end = 0.; ///< [s] of the window
  int                         samples       = 0;
  double                      resolution_hz = 0.; ///< 1 / (end - begin); a line is two of them wide
  std::vector<SignalSpectrum> signals;
};

} // namespace gestell::apps
