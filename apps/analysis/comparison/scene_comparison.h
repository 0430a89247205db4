#pragma once

#include "apps/analysis/analysis.h"
#include "apps/analysis/comparison/run_comparison.h"

namespace gestell::apps
{

/// Adds to the result of a session the comparison of its modes with those of another one, see compared_shapes().
/// @throws std::invalid_argument if they have no common DOF, with examples of both
void add_compared_modes(Session &session, Result &result, Session &other);

/// @throws std::invalid_argument if one of two scenes has no run, or they have no signal of the same name and unit
void require_comparable_runs(Session &session, Session &other);

/// Runs another scene and adds the comparison to the result of a run; also that of the modes if both have common DOFs.
void add_compared_run(Session &session, Result &result, Session &other);

/// Comparison with another run, for report and summary.
std::shared_ptr<const Answer> compared_run_answer(ComparedRun compared);

} // namespace gestell::apps
