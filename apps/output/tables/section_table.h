#pragma once

#include "apps/output/values/periodic_result.h"

#include <string>

namespace gestell::apps
{

/// What a motion does in the long run, in a sentence.
std::string long_run_text(const LongRun &run);

/// section.csv: `period`, every coordinate and its rate ("NAME", "NAME'"), every signal; a row at the begin of each
/// period.  Empty: the motion was not followed.
std::string section_csv(const PeriodicResult &result);

} // namespace gestell::apps
