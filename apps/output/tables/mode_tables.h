#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// modes.csv: modes of the frame alone, then of the coupled machine, each numbered from 1.
CsvTable modes_csv(const Result &result);

/// mode_energies.csv: one row per coupled mode and part of the machine, with the shares of strain and kinetic energy.
CsvTable mode_energies_csv(const Result &result);

/// For a terminal: "frame 97 %, clutch 3 %", the largest first; shares below one percent are omitted.
std::string strain_text(const coupling::EnergyShares &shares, std::size_t mode);
std::string kinetic_text(const coupling::EnergyShares &shares, std::size_t mode);

} // namespace gestell::apps
