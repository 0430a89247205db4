#pragma once

#include "apps/session/frf_options.h"
#include "apps/session/prepared_machine.h"

namespace gestell::apps
{

/// What can be known of the options without a machine.
/// @throws std::invalid_argument: which, the value, and what is needed
void check_frf_options(const FrfOptions &options);

/// Frequency responses of a scene's machine, on the reduced frame where it has an unreduced one.
/// Frequencies are placed about the modes of the operating point, contacts as they are there.
/// @throws std::invalid_argument for options that do not fit
FrequencyResponse frequency_response_of(const Scene &scene, PreparedMachine &prepared, const FrfOptions &options,
                                        const coupling::Progress &progress, std::vector<std::string> &warnings);

} // namespace gestell::apps
