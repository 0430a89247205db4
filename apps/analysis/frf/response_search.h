#pragma once

#include "apps/analysis/frf/frequency_response.h"
#include "apps/session/prepared_machine.h"
#include "coupling/modes/operating_point.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// What frequency responses are asked for; texts are quantities as they are typed.
struct FrfOptions
{
  std::vector<std::string> from, to;            ///< signal paths, signals of the scene, bodies
  std::string              kind = "receptance"; ///< or "mobility", "accelerance"
  std::string              at   = "start";      ///< or "equilibrium", "undeformed"
  std::string              lowest, highest;     ///< "1 Hz"; empty: about the modes of the machine
  int                      points  = 400;       ///< those that peaks ask for are added
  std::string              spacing = "log";     ///< or "linear"
  std::vector<std::string> measured;            ///< files, or NAME=FILE
};

/// What can be known of the options without a machine.
/// @throws std::invalid_argument: which, the value, and what is needed
void check_frf_options(const FrfOptions &options);

/// Frequency responses of a scene's machine, on the reduced frame where it has an unreduced one.
/// Frequencies are placed about the modes of the operating point, contacts as they are there.
/// @throws std::invalid_argument for options that do not fit
FrequencyResponse frequency_response_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options,
                                        const coupling::Progress &progress, std::vector<std::string> &warnings);

/// The machine of a scene at an operating point of FrfOptions.
coupling::MachinePoint operating_point(const Scene &scene, coupling::Machine &machine, const std::string &at);

/// What a force acts along, or what answers.
struct NamedResponse
{
  coupling::LinearAnswer answer;
  std::string            unit;            ///< "m" of the signal itself
  int                    derivatives = 0; ///< by time, that `kind` asks for
};

/// Answers in the order of options.to.
std::vector<NamedResponse> named_answers(const Scene &scene, const coupling::Machine &machine,
                                         const FrfOptions &options, const coupling::MachinePoint &point);
/// Unit forces [n x inputs] in the order of options.from, and the unit of what each acts along.
std::pair<Eigen::MatrixXd, std::vector<std::string>> named_forces(const Scene &scene, const coupling::Machine &machine,
                                                                  const FrfOptions             &options,
                                                                  const coupling::MachinePoint &point);

} // namespace gestell::apps
