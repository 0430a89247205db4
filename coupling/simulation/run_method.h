#pragma once

#include "coupling/machine/machine.h"
#include "coupling/simulation/signal_extremes.h"

namespace gestell::coupling
{

/// The method of a run; the largest step of a controlled one small enough that no load goes by between two steps.
MethodOptions with_largest_step(const Machine &machine, const RunOptions &options);

/// Fixed steps of implicit methods are short against what they show; controlled ones are as long as their order allows.
/// Exact propagation shows modes far above its step: 32 samples in a period show them.
Sampling sampling_of(const Machine &machine, const MethodOptions &method);

} // namespace gestell::coupling
