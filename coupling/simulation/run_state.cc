#include "coupling/simulation/run_state.h"

#include "coupling/integration/system/state_archive.h"

namespace gestell::coupling
{

void exchange(StateArchive &archive, KeptState &state)
{
  archive(state.t, state.q, state.v, state.p);
}

void exchange(StateArchive &archive, SignalSummary &summary)
{
  archive(summary.min, summary.t_min, summary.max, summary.t_max, summary.final);
}

void exchange(StateArchive &archive, EventValues &values)
{
  archive(values.t, values.before, values.after, values.rate);
}

} // namespace gestell::coupling
