#pragma once

#include "coupling/periodic/response/response_peaks.h"

#include <complex>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A curve that was measured at a machine.
struct MeasuredResponse
{
  std::string                       file, name;    ///< what the file calls it, may be empty
  int                               pair      = 0; ///< of FrequencyResponse::pairs, in whose unit the values are
  bool                              has_phase = true;
  std::vector<double>               frequencies_hz;
  std::vector<std::complex<double>> values;
};

/// Answer of one place to a force at one place.
struct ResponsePair
{
  std::string from, to;
  std::string unit;                           ///< "m/N"
  int         derivatives = 0;                ///< by time, of a displacement: 0 receptance, 1 mobility, 2 accelerance
  std::vector<std::complex<double>>   values; ///< by frequency; nan where an undamped mode is driven
  std::vector<coupling::ResponsePeak> peaks;

  std::string name() const { return to + "/" + from; }
};

/// Vibration of the machine, linearised at an operating point, per harmonic force.
struct FrequencyResponse
{
  std::string                   kind;                           ///< "receptance", "mobility", "accelerance"
  std::string                   at;                             ///< "start", "equilibrium", "undeformed"
  double                        t     = 0.;                     ///< [s] of the operating point
  bool                          moves = false;                  ///< it is a motion, not rest
  std::vector<std::string>      closed_contacts, open_contacts; ///< names of elements with play
  std::string                   not_condensed;      ///< why the whole equations were solved; empty: they were condensed
  bool                          logarithmic = true; ///< axis of the frequencies
  std::vector<double>           frequencies_hz;     ///< ascending
  std::vector<ResponsePair>     pairs;
  std::vector<MeasuredResponse> measured;
};

} // namespace gestell::apps
