#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// `mode, frequency [Hz], energy, part, share`: a row for each part of a coupled mode's strain and kinetic energy.
std::string mode_energies_csv(const Result &result);

/// For a terminal: "frame 97 %, clutch 3 %", the largest first; shares below a percent are left out.
std::string strain_text(const coupling::EnergyShares &shares, std::size_t mode);
std::string kinetic_text(const coupling::EnergyShares &shares, std::size_t mode);

} // namespace gestell::apps
