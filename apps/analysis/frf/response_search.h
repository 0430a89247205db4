#pragma once

#include "apps/analysis/frf/frequency_response.h"
#include "apps/session/prepared_machine.h"
#include "coupling/modes/operating_point.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Options of `frf`; strings are quantities as typed.
struct FrfOptions
{
  std::vector<std::string> from, to;            ///< signal paths, signals of the scene, bodies
  std::string              kind = "receptance"; ///< or "mobility", "accelerance"
  std::string              at   = "start";      ///< or "equilibrium", "undeformed"
  std::string              lowest, highest;     ///< "1 Hz"; empty: around the modes of the machine
  int                      points  = 400;       ///< points at peaks are added
  std::string              spacing = "log";     ///< or "linear"
  std::vector<std::string> measured;            ///< files, or NAME=FILE
};

/// Checks the options that need no machine.
/// @throws std::invalid_argument with the option, its value and the requirement
void check_frf_options(const FrfOptions &options);

/// Frequency responses of a scene's machine, on the reduced frame if there is an unreduced one.  Frequencies are placed
/// around the modes at the operating point, with the contact states there.
/// @throws std::invalid_argument for invalid options
FrequencyResponse frequency_response_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options,
                                        const coupling::Progress &progress, std::vector<std::string> &warnings);

/// The machine of a scene at an operating point given as in FrfOptions.
coupling::MachinePoint operating_point(const Scene &scene, coupling::Machine &machine, const std::string &at);

/// A signal along which a force acts or a response is computed.
struct NamedResponse
{
  coupling::LinearAnswer answer;
  std::string            unit;            ///< of the signal itself, "m"
  int                    derivatives = 0; ///< number of time derivatives for `kind`
};

/// Responses in the order of options.to.
std::vector<NamedResponse> named_answers(const Scene &scene, const coupling::Machine &machine,
                                         const FrfOptions &options, const coupling::MachinePoint &point);
/// Unit forces [n x inputs] in the order of options.from, and the unit of the signal along which each acts.
std::pair<Eigen::MatrixXd, std::vector<std::string>> named_forces(const Scene &scene, const coupling::Machine &machine,
                                                                  const FrfOptions             &options,
                                                                  const coupling::MachinePoint &point);

} // namespace gestell::apps
