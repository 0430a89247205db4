#pragma once

#include "coupling/simulation/run_result.h"

namespace gestell::coupling
{

class StateArchive;

void exchange(StateArchive &archive, SignalSummary &summary); ///< everything except its name
void exchange(StateArchive &archive, EventValues &values);
void exchange(StateArchive &archive, KeptState &state);

} // namespace gestell::coupling
