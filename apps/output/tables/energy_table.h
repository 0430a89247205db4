#pragma once

#include "apps/output/text/json.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// `mode, frequency [Hz], energy, part, share`: a row for each part of a coupled mode's strain and kinetic energy.
std::string mode_energies_csv(const Result &result);

/// Of summary.json: for each coupled mode `strain` and `kinetic`, shares by name.
Json mode_energies_json(const coupling::EnergyShares &shares);

/// For a terminal: "frame 97 %, clutch 3 %", the largest first; shares below a percent are left out.
std::string strain_text(const coupling::EnergyShares &shares, std::size_t mode);
std::string kinetic_text(const coupling::EnergyShares &shares, std::size_t mode);

} // namespace gestell::apps
