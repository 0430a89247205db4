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
  double                      row_step      = 0.; ///< [s] between the rows
  double                      carried_hz    = 0.; ///< up to which the rows carry; faster motion of theirs folds
  std::vector<SignalSpectrum> signals;
};

} // namespace gestell::apps
