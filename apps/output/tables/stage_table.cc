#include "apps/output/tables/stage_table.h"

#include "fem/values/number_text.h"

#include <iomanip>
#include <sstream>

namespace gestell::apps
{

namespace
{

Json mode_json(const Ringing &ringing, const RingingMode &mode)
{
  Json json = {{"damped_frequency_hz", mode.frequency_hz}, {"damping_ratio", mode.damping_ratio}};
  for (std::size_t s = 0; s < ringing.signals.size(); ++s)
    json["amplitudes"][ringing.signals[s]] = mode.amplitudes[s];
  json["combination"] = mode.combination.empty() ? Json() : Json(mode.combination);
  json["linearised"]  = mode.linearised < 0 ? Json()
                                            : Json{{"mode", mode.linearised + 1},
                                                  {"damped_frequency_hz", mode.linearised_hz},
                                                  {"damping_ratio", mode.linearised_ratio}};
  return json;
}

void add_lift_offs(const std::vector<LiftOff> &lift_offs, std::ostream &text)
{
  for (const LiftOff &off : lift_offs)
    text << "  " << off.wheel << " is off the ground from " << short_text(off.begin, 6) << " to "
         << short_text(off.end, 6) << " s\n";
}

void add_ringing(const Ringing &ringing, std::ostream &text)
{
  text << "ringing from " << short_text(ringing.begin) << " to " << short_text(ringing.end)
       << " s, identified | linearised at rest: damped frequency [Hz], damping ratio\n";
  for (const RingingMode &mode : ringing.modes)
  {
    text << std::setw(14) << short_text(mode.frequency_hz, 5) << std::setw(12) << short_text(mode.damping_ratio, 3);
    if (mode.linearised >= 0)
      text << "   | " << std::setw(10) << short_text(mode.linearised_hz, 5) << std::setw(12)
           << short_text(mode.linearised_ratio, 3) << "   mode " << mode.linearised + 1;
    if (!mode.combination.empty())
      text << "   = " << mode.combination;
    text << '\n';
  }
}

} // namespace

Json stages_json(const StageResult &result)
{
  Json json = Json::array();
  for (const Stage &stage : result.stages)
  {
    Json signals = Json::object();
    for (const StageExtremes &own : stage.extremes)
      signals[own.signal] = {
          {"unit", own.unit}, {"min", own.min}, {"t_min", own.t_min}, {"max", own.max}, {"t_max", own.t_max}};
    json.push_back({{"name", stage.name}, {"begin", stage.begin}, {"end", stage.end}, {"signals", signals}});
  }
  return json;
}

Json lift_off_json(const StageResult &result)
{
  Json json = Json::array();
  for (const LiftOff &off : result.lift_offs)
    json.push_back({{"wheel", off.wheel}, {"from", off.begin}, {"to", off.end}});
  return json;
}

Json ringing_json(const StageResult &result)
{
  const Ringing &ringing = result.ringing;
  Json           modes   = Json::array();
  for (const RingingMode &mode : ringing.modes)
    modes.push_back(mode_json(ringing, mode));
  return {{"begin", ringing.begin},       {"end", ringing.end}, {"step", ringing.step}, {"signals", ringing.signals},
          {"residual", ringing.residual}, {"modes", modes},     {"note", result.reason}};
}

std::string stages_text(const StageResult &result)
{
  std::ostringstream text;
  for (const Stage &stage : result.stages)
    text << "stage " << stage.name << ": " << short_text(stage.begin, 6) << " to " << short_text(stage.end, 6)
         << " s\n";
  add_lift_offs(result.lift_offs, text);
  if (!result.ringing.modes.empty())
    add_ringing(result.ringing, text);
  if (!result.reason.empty() && !result.ringing.signals.empty())
    text << "ringing: " << result.reason << '\n';
  return text.str();
}

} // namespace gestell::apps
