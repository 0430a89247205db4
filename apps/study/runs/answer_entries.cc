#include "apps/study/runs/answer_entries.h"

#include "apps/output/tables/summary_json.h"
#include "apps/output/text/json.h"
#include "apps/study/file/event_kinds.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps::answer_entry
{
namespace
{

using Segments = std::vector<std::string>;

constexpr double never = std::numeric_limits<double>::quiet_NaN();

const Segments &signal_kinds()
{
  static const Segments kinds{"min", "max", "t_min", "t_max", "final", "range"};
  return kinds;
}

std::string joined(const Segments &segments)
{
  std::string text;
  for (const std::string &segment : segments)
    text += (text.empty() ? "" : ".") + segment;
  return text;
}

[[noreturn]] void refuse(const Segments &segments, const std::string &why)
{
  throw std::invalid_argument("'" + joined(segments) + "' " + why);
}

bool among(const Segments &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_count(const std::string &text)
{
  return !text.empty() && text.size() < 8 && text.find_first_not_of("0123456789") == std::string::npos && text != "0";
}

bool is_mode(const Segments &segments)
{
  return segments.front() == "modes" || segments.front() == "frequencies_hz";
}

Segments signal_names(const Scene &scene)
{
  Segments names;
  for (const SignalRequest &signal : scene.signals)
    names.push_back(signal.name);
  return names;
}

/// Things of a scene that events can be of.
Segments event_names(const Scene &scene)
{
  Segments names;
  for (const auto &element : scene.elements)
    names.push_back(element.name);
  for (const auto &joint : scene.joints)
    names.push_back(joint.name);
  for (const auto &one : scene.switches)
    names.push_back(one.request.name);
  return names;
}

bool is_choice(const std::string &word)
{
  return word == "first" || word == "last" || word == "count" || is_count(word);
}

Segments kinds_and_choices()
{
  Segments words = event_kinds();
  words.insert(words.end(), {"first", "last", "count"});
  return words;
}

void check_signal(const Segments &segments, const Scene &scene)
{
  const Segments names = signal_names(scene);
  if (segments.size() < 2 || !among(names, segments[1]))
    refuse(segments, "names no signal of the scene" + suggestion(segments.size() < 2 ? "" : segments[1], names));
  if (segments.size() != 3 || !among(signal_kinds(), segments[2]))
    refuse(segments, "does not say what of the signal: " + joined({"signals", segments[1], "max"}) +
                         ", .min, .t_max, .t_min, .final or .range");
}

void check_event(const Segments &segments, const Scene &scene)
{
  const Segments names = event_names(scene);
  if (segments.size() < 2 || !among(names, segments[1]))
    refuse(segments, "names nothing of the scene that events happen to" +
                         suggestion(segments.size() < 2 ? "" : segments[1], names));
  if (segments.size() > 4)
    refuse(segments,
           "has too many parts; an event is written events.NAME.KIND, with .first, .last, .count or a number");
  if (segments.size() == 4 && !is_choice(segments[3]))
    refuse(segments, "does not say which of the events: .first, .last, .count or a number" +
                         suggestion(segments[3], {"first", "last", "count"}));
  if (segments.size() > 2 && !(segments.size() == 3 && is_choice(segments[2])) && !is_event_kind(segments[2]))
    refuse(segments, "names '" + segments[2] + "', which is not a kind of event" +
                         suggestion(segments[2], kinds_and_choices()) +
                         "; the kinds that occur stand in summary.json of a run");
}

AnswerValue signal_value(const Segments &segments, const coupling::RunResult &run)
{
  const auto signal = std::find_if(run.signals.begin(), run.signals.end(),
                                   [&](const coupling::SignalSummary &one) { return one.name == segments[1]; });
  if (signal == run.signals.end())
    refuse(segments, "names no signal of the run");
  const std::string &kind = segments[2];
  if (kind == "t_min" || kind == "t_max")
    return {kind == "t_min" ? signal->t_min : signal->t_max, "s"};
  return {kind == "min"     ? signal->min
          : kind == "max"   ? signal->max
          : kind == "final" ? signal->final
                            : signal->max - signal->min,
          signal->unit};
}

/// Times of the events of that name, and of that kind if one is given.
std::vector<double> times_of(const std::string &name, const std::string &kind, const coupling::RunResult &run)
{
  std::vector<double> times;
  for (const coupling::Event &event : run.events)
    if (event.name == name && (kind.empty() || event.kind == kind))
      times.push_back(event.t);
  return times;
}

AnswerValue event_value(const Segments &segments, const coupling::RunResult &run)
{
  const bool          chosen = segments.size() > 2 && is_choice(segments.back());
  const std::string   choice = chosen ? segments.back() : "first";
  const bool          kind   = segments.size() > (chosen ? 3u : 2u);
  std::vector<double> times  = times_of(segments[1], kind ? segments[2] : "", run);
  if (choice == "count")
    return {double(times.size()), ""};
  const std::size_t at = choice == "first" ? 1 : choice == "last" ? times.size() : std::stoul(choice);
  return {at >= 1 && at <= times.size() ? times[at - 1] : never, "s"};
}

AnswerValue mode_value(const Segments &segments, const Result &result)
{
  const auto &modes = result.coupled_modes;
  if (segments.size() != 2 || !is_count(segments[1]) || std::stoul(segments[1]) > modes.size())
    refuse(segments, "needs the number of a mode from 1 to " + std::to_string(modes.size()));
  return {modes[std::stoul(segments[1]) - 1].frequency_hz, "Hz"};
}

Segments keys_of(const Json &json)
{
  Segments keys;
  if (json.is_object())
    for (const auto &[key, value] : json.items())
      keys.push_back(key);
  return keys;
}

/// By the path with "[]" in place of numbers; "" of a number without a unit.
std::string unit_in_summary(const Segments &segments, const Json &units)
{
  std::string path;
  for (const std::string &segment : segments)
    path += is_count(segment) ? "[]" : (path.empty() ? "" : ".") + segment;
  if (is_count(segments.back())) // a list has a unit as a whole
    path.resize(path.size() - 2);
  const std::string unit = units.value(path, "");
  return unit == "1" ? "" : unit;
}

/// Of summary.json; elements of arrays are counted from 1.
AnswerValue summary_value(const Segments &segments, const Result &result)
{
  const Json  all  = Json::parse(summary_json(result));
  const Json *node = &all;
  for (const std::string &segment : segments)
  {
    if (node->is_array() && is_count(segment) && std::stoul(segment) <= node->size())
      node = &(*node)[std::stoul(segment) - 1];
    else if (node->is_object() && node->contains(segment))
      node = &(*node)[segment];
    else
      refuse(segments, "is not a number of a run's summary.json: there is no '" + segment + "'" +
                           (node->is_array() ? " among " + std::to_string(node->size()) + " entries, counted from 1"
                                             : suggestion(segment, keys_of(*node))));
  }
  if (node->is_boolean())
    return {node->get<bool>() ? 1. : 0., ""};
  if (node->is_null())
    return {never, ""};
  if (!node->is_number())
    refuse(segments, "is not a number in a run's summary.json" +
                         (node->is_object() ? "; name one of its entries: " + listed(keys_of(*node)) : ""));
  return {node->get<double>(), unit_in_summary(segments, all["units"])};
}

} // namespace

const std::vector<std::string> &tables()
{
  static const Segments names{"signals", "events", "modes", "frequencies_hz", "frame_frequencies_hz",
                              "energy",  "work",   "model", "stress",         "operating_poles",
                              "outcome", "life"};
  return names;
}

void check(const std::vector<std::string> &segments, const Scene &scene)
{
  if (segments.front() == "signals")
    check_signal(segments, scene);
  else if (segments.front() == "events")
    check_event(segments, scene);
  else if (is_mode(segments) &&
           (segments.size() != 2 || !is_count(segments[1]) || std::stoi(segments[1]) > scene.modes.number))
    refuse(segments, "needs the number of a mode from 1 to " + std::to_string(scene.modes.number) +
                         "; modes.number of the scene sets how many are listed");
  else if (segments.front() == "stress" && !scene.stress.given)
    refuse(segments, "asks for stresses, which the scene does not compute; give it [output.stress]");
}

AnswerValue value(const std::vector<std::string> &segments, const Result &result)
{
  if (segments.front() == "signals")
    return signal_value(segments, *result.run);
  if (segments.front() == "events")
    return event_value(segments, *result.run);
  if (is_mode(segments))
    return mode_value(segments, result);
  return summary_value(segments, result);
}

} // namespace gestell::apps::answer_entry
