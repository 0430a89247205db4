#pragma once

#include "apps/output/values/frequency_response.h"

#include <string>

namespace gestell::apps
{

/// frf.csv: a row per frequency, for each pair real and imaginary part, amplitude and phase; full precision, SI.
std::string frequency_response_csv(const FrequencyResponse &response);

/// Phase [deg] in (-180, 180].
double phase_degrees(std::complex<double> value);

} // namespace gestell::apps
