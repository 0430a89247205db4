#pragma once

#include "apps/output/values/periodic_result.h"

#include <string>

namespace gestell::apps
{

/// The shares of the starts by motions, in a sentence.
std::string basins_text(const BasinMap &map);

/// basins.csv: both coordinates of every start that was looked at, the solution it settles to (0: none) and after how
/// many periods it was there.  Empty: there are no basins.
std::string basins_csv(const PeriodicResult &result);

} // namespace gestell::apps
