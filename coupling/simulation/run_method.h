#pragma once

#include "coupling/machine/machine.h"
#include "coupling/simulation/signal_extremes.h"

namespace gestell::coupling
{

/// The method of a run; the largest step of a controlled one is limited so that no load is missed between two steps.
MethodOptions with_largest_step(const Machine &machine, const RunOptions &options);

/// Sampling of the signals.  Fixed steps of implicit methods are short compared with the motion they resolve;
/// controlled steps are as long as their order allows.  Exact propagation resolves modes far above its step: they are
/// sampled 32 times per period.
Sampling sampling_of(const Machine &machine, const MethodOptions &method);

} // namespace gestell::coupling
