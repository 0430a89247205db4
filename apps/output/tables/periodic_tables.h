#pragma once

#include "apps/output/values/periodic_result.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

std::string solutions_csv(const PeriodicResult &result);
std::string multipliers_csv(const PeriodicResult &result);
std::string special_points_csv(const PeriodicResult &result);
/// orbit_1.csv ... of all solutions: names and contents.
std::vector<std::pair<std::string, std::string>> orbit_files(const PeriodicResult &result);
} // namespace gestell::apps
