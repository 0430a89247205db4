#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/periodic_result.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// "parameters.n [rad/s]"
std::string parameter_head(const PeriodicResult &result);

CsvTable solutions_csv(const PeriodicResult &result);
CsvTable multipliers_csv(const PeriodicResult &result);
CsvTable special_points_csv(const PeriodicResult &result);
/// Names and contents of orbit_1.csv ... of all solutions.
std::vector<std::pair<std::string, std::string>> orbit_files(const PeriodicResult &result);

/// section.csv: `period`, every coordinate and its rate ("NAME", "NAME'"), every signal; one row at the start of each
/// period.  Empty: no long-term run was computed.
CsvTable section_csv(const PeriodicResult &result);

/// basins.csv: both coordinates of every initial state examined, the solution it settles to (0: none) and the number of
/// periods until then.  Empty: no basins were computed.
CsvTable basins_csv(const PeriodicResult &result);

/// Long-term behaviour of a motion, in a sentence.
std::string long_run_text(const LongRun &run);

/// Share of the initial states that settle to each solution, in a sentence.
std::string basins_text(const BasinMap &map);

} // namespace gestell::apps
