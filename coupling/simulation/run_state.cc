#include "coupling/simulation/run_state.h"

#include "coupling/integration/system/state_archive.h"
#include "coupling/simulation/crawl_watch.h"
#include "coupling/simulation/recorder.h"

namespace gestell::coupling
{

void CrawlWatch::exchange(StateArchive &archive)
{
  archive(from_);
}

void exchange(StateArchive &archive, KeptState &state)
{
  archive(state.t, state.q, state.v);
}

void exchange(StateArchive &archive, SignalSummary &summary)
{
  archive(summary.min, summary.t_min, summary.max, summary.t_max, summary.final);
}

void exchange(StateArchive &archive, EventValues &values)
{
  archive(values.t, values.before, values.behind, values.rate);
}

void SignalSample::exchange(StateArchive &archive)
{
  archive(t, values);
}

void SignalExtremes::exchange(StateArchive &archive)
{
  archive(samples_, watched_, anew_, n_, begin_);
}

void Recorder::exchange(StateArchive &archive)
{
  archive(result_.signals, result_.rows, result_.event_values, result_.energy, result_.picture_times,
          result_.picture_states, result_.picture_velocities);
  archive(keeper_, energy_, guard_, between_, a_, extremes_, behind_, pending_, length_, settled_, next_row_,
          next_picture_, close_until_, close_budget_);
}

} // namespace gestell::coupling
