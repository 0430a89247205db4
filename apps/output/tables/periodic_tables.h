#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/periodic_result.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

CsvTable solutions_csv(const PeriodicResult &result);
CsvTable multipliers_csv(const PeriodicResult &result);
CsvTable special_points_csv(const PeriodicResult &result);
/// orbit_1.csv ... of all solutions: names and contents.
std::vector<std::pair<std::string, std::string>> orbit_files(const PeriodicResult &result);

/// section.csv: `period`, every coordinate and its rate ("NAME", "NAME'"), every signal; a row at the start of each
/// period.  Empty: the motion was not followed.
CsvTable section_csv(const PeriodicResult &result);

/// basins.csv: both coordinates of every start that was examined, the solution it settles to (0: none) and after how
/// many periods it was there.  Empty: there are no basins.
CsvTable basins_csv(const PeriodicResult &result);

/// What a motion does in the long run, in a sentence.
std::string long_run_text(const LongRun &run);

/// The shares of the starts by motions, in a sentence.
std::string basins_text(const BasinMap &map);

} // namespace gestell::apps
