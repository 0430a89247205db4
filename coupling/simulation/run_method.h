#pragma once

#include "coupling/machine/machine.h"
#include "coupling/simulation/run_result.h"

namespace gestell::coupling
{

/// The method of a run; the largest step of a controlled one small enough that no load goes by between two steps.
MethodOptions with_largest_step(const Machine &machine, const RunOptions &options);

} // namespace gestell::coupling
