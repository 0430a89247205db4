#include "apps/output/tables/stage_table.h"

#include "apps/output/describe/described_table.h"
#include "fem/values/number_text.h"

namespace gestell::apps
{

std::string stages_text(const StageResult &result)
{
  std::string text;
  for (const Stage &stage : result.stages)
    text += "stage " + stage.name + ": " + short_text(stage.begin, 6) + " to " + short_text(stage.end, 6) + " s\n";
  for (const LiftOff &off : result.lift_offs)
    text += "  " + off.wheel + " is off the ground from " + short_text(off.begin, 6) + " to " + short_text(off.end, 6) +
            " s\n";
  const Ringing &ringing = result.ringing;
  if (!ringing.modes.empty())
    text += "ringing from " + short_text(ringing.begin) + " to " + short_text(ringing.end) +
            " s, beside the machine linearised at rest\n" + table_of(ringing.modes).terminal();
  if (!ringing.note.empty() && !ringing.signals.empty())
    text += "ringing: " + ringing.note + '\n';
  return text;
}

} // namespace gestell::apps
