#pragma once

#include "coupling/simulation/run_result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A scalar result of a run: `SIGNAL.min`, `.max`, `.t_min`, `.t_max`, `.final`, `.range`, or the frequency of a
/// coupled mode, `modes.2`.
struct OutputName
{
  std::string text;
  std::string signal, kind; ///< if it is of a signal
  int         mode = 0;     ///< from 1; 0: it is of a signal

  bool of_signal() const { return mode == 0; }
};

/// @param given    as typed
/// @param signals  names of the signals of the scene
/// @param modes    number of modes that the scene computes
/// @throws std::invalid_argument if there is no such output, or it is a count
OutputName output_named(const std::string &given, const std::vector<std::string> &signals, int modes);

/// Outputs of a comma-separated list; for an empty list the largest and smallest value of every signal.
std::vector<OutputName> outputs_named(const std::string &list, const std::vector<std::string> &signals, int modes);

/// Names of the signals of these outputs.
std::vector<std::string> signals_of(const std::vector<OutputName> &outputs);

/// Value of an output from the summary of its signal.
double      value_of(const OutputName &output, const coupling::SignalSummary &signal);
std::string unit_of(const OutputName &output, const coupling::SignalSummary &signal);
/// Time [s] after which the run does not change the value.
double decided_at(const OutputName &output, const coupling::SignalSummary &signal, double end);

} // namespace gestell::apps
