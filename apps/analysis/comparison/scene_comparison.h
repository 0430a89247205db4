#pragma once

#include "apps/analysis/analysis.h"
#include "apps/analysis/comparison/run_comparison.h"

namespace gestell::apps
{

/// Adds to the result of a session its modes beside those of another one, see compared_shapes().
/// @throws std::invalid_argument if they share no motion; it names some of both
void add_compared_modes(Session &session, Result &result, Session &other);

/// @throws std::invalid_argument if two scenes do not run, or have no signal of one name and unit
void require_comparable_runs(Session &session, Session &other);

/// Runs another scene and adds its run, and its modes where both share a motion, to the result of a run.
void add_compared_run(Session &session, Result &result, Session &other);

/// Of another run, for report and summary.
std::shared_ptr<const Answer> compared_run_answer(ComparedRun compared);

} // namespace gestell::apps
