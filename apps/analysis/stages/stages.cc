#include "apps/analysis/stages/stage_result.h"

#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/stages/ringing.h"
#include "apps/session/history_rows.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using coupling::Event;
using coupling::RunResult;

bool is_border(const Event &event, const std::string &border)
{
  return event.name == border || event.name + "." + event.kind == border;
}

StageExtremes extremes_of(const HistoryRows &rows, const std::string &signal, const Stage &stage)
{
  const std::size_t column = rows.column(signal);
  constexpr double  nan    = std::numeric_limits<double>::quiet_NaN();
  StageExtremes     found{signal, rows.unit(column), nan, nan, nan, nan};
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const double t = rows.t(i), y = rows.at(i, column);
    if (t < stage.begin || t > stage.end)
      continue;
    if (!(found.min <= y))
      found.min = y, found.t_min = t;
    if (!(found.max >= y))
      found.max = y, found.t_max = t;
  }
  return found;
}

/// For a missed boundary: the closest value of the signal of its switch.
std::string unreached(const Scene &scene, const std::string &border, const RunResult &run)
{
  std::string text = scene.stages.place + ": the run did not reach the stage boundary '" + border + "'";
  const auto  own  = std::find_if(scene.switches.begin(), scene.switches.end(),
                                  [&](const SwitchRequest &any)
                                  { return any.request.name == border || any.request.name + ".switch" == border; });
  if (own == scene.switches.end())
    return text + ", because no event has this name; report and summary.json list the events of a run";
  const bool rises  = own->request.crossing != coupling::SwitchCrossing::falling;
  const auto signal = std::find_if(scene.signals.begin(), scene.signals.end(),
                                   [&](const SignalRequest &any) { return any.path == own->request.signal; });
  if (const HistoryRows rows(run); signal != scene.signals.end() && rows.size() > 0)
  {
    const Stage         all{"", rows.t(0), rows.t(rows.size() - 1), {}};
    const StageExtremes found = extremes_of(rows, signal->name, all);
    text += ": " + own->request.signal + " reaches " + rounded(rises ? found.max : found.min) + " " + found.unit +
            " at " + rounded(rises ? found.t_max : found.t_min) + " s";
  }
  return text + "; its switch needs " + rounded(own->request.level) + " (" + own->place +
         "); change the value of the switch, or extend the run (run.end)";
}

/// A first stage of no length.
std::string over_at_start(const Scene &scene, const std::string &border)
{
  std::string text = scene.stages.place + ": the stage '" + scene.stages.names.front() +
                     "' is empty, because its boundary '" + border + "' occurs at the start";
  for (const SwitchRequest &own : scene.switches)
    if (own.request.name == border)
      text += ": " + own.request.signal + " has already reached " + rounded(own.request.level) + " (" + own.place +
              "); change the initial state or the value of the switch";
  return text;
}

/// @return why there are fewer than requested; empty: there are not
std::string add_stages(const Scene &scene, const RunResult &run, StageResult &result)
{
  const HistoryRows rows(run);
  const double      begin = rows.t(0), end = rows.t(rows.size() - 1);
  double            from  = begin;
  auto              event = run.events.begin();
  std::string       reason;
  const std::size_t n = scene.stages.names.size();
  for (std::size_t i = 0; i < n && reason.empty(); ++i)
  {
    Stage stage{scene.stages.names[i], from, end, {}};
    if (i + 1 < n)
    {
      const std::string &border = scene.stages.borders[i];
      event = std::find_if(event, run.events.end(), [&](const Event &any) { return is_border(any, border); });
      if (event == run.events.end())
        reason = unreached(scene, border, run);
      else
      {
        if (i == 0 && event->t <= begin)
          return over_at_start(scene, border);
        stage.end = from = event->t;
        ++event;
      }
    }
    for (const SignalRequest &signal : scene.signals)
      stage.extremes.push_back(extremes_of(rows, signal.name, stage));
    result.stages.push_back(std::move(stage));
  }
  return reason;
}

} // namespace

std::vector<LiftOff> lift_off_intervals(const RunResult &run, double begin, double end)
{
  std::vector<LiftOff>     intervals;
  std::vector<std::string> visited; // wheels with an event
  for (const Event &event : run.events)
  {
    if (event.kind != "lift_off" && event.kind != "touch_down")
      continue;
    const bool first = std::find(visited.begin(), visited.end(), event.name) == visited.end();
    if (first)
      visited.push_back(event.name);
    if (event.kind == "lift_off")
      intervals.push_back({event.name, event.t, end});
    else if (first)
      intervals.push_back({event.name, begin, event.t});
    else
      std::find_if(intervals.rbegin(), intervals.rend(), [&](const LiftOff &any) { return any.wheel == event.name; })
          ->end = event.t;
  }
  return intervals;
}

namespace
{

/**
 * The stages of [output.stages], the ringing in the last one, and the intervals in which wheels are off the ground;
 * none for a run without both.  Modes are identified after the last event of a contact by matrix_pencil(), and compared
 * with those of the machine linearised at rest with its driven joints in their final position.  A boundary that the run
 * does not reach, or that is at its start, makes the run fail, unless it has failed already: the message contains the
 * signal of the switch, the value reached, the value required and the possible changes.
 */
class StagesOfRun : public Analysis
{
public:
  void after_motion(RunInProgress &run) override
  {
    const Scene      &scene  = run.session.scene();
    RunResult        &motion = *run.result.run;
    const HistoryRows rows(motion);
    if (rows.size() == 0)
      return;
    StageResult result;
    result.lift_offs = lift_off_intervals(motion, rows.t(0), rows.t(rows.size() - 1));
    if (scene.stages.given())
      divide(scene, run.session.machine(), motion, result);
    if (scene.stages.given() || !result.lift_offs.empty())
      run.result.answers.push_back(as_answer(std::move(result)));
  }

private:
  static void divide(const Scene &scene, PreparedMachine &prepared, RunResult &run, StageResult &result)
  {
    const std::string missing = add_stages(scene, run, result);
    if (!missing.empty())
    {
      result.ringing.note = missing;
      if (!run.interrupted)
        run.stop("stages", "stages", missing);
    }
    else if (!scene.stages.ringing.empty() && run.failure.empty() && prepared.machine.size() == run.end_state.size())
      find_ringing(scene, prepared, run.end_state, run, result);
  }
};

} // namespace

AnalysisEntry stage_analysis()
{
  return analysis_entry<StagesOfRun, StageResult>("stages", "", {}, {}, "run");
}

} // namespace gestell::apps
