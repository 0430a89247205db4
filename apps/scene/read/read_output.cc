#include "apps/scene/read/read_output.h"

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/read_run.h"
#include "apps/scene/values/requests.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

std::vector<std::string> stage_names(const SceneTable &stages, std::size_t n_borders)
{
  std::vector<std::string> names;
  if (!stages.has("names"))
    for (std::size_t i = 0; i <= n_borders; ++i)
      names.push_back("stage " + std::to_string(i + 1));
  else
    names = stages.texts("names");
  if (names.size() != n_borders + 1)
    throw stages.error("names", std::to_string(names.size()) + " names, but " + count_text(n_borders, "border") +
                                    " for " + std::to_string(n_borders + 1) +
                                    " stages; give one more name than boundaries");
  return names;
}

void require_signals(const SceneTable &stages, const Scene &scene)
{
  std::vector<std::string> valid;
  for (const SignalRequest &signal : scene.signals)
    valid.push_back(signal.name);
  for (const std::string &name : scene.stages.ringing)
    if (std::find(valid.begin(), valid.end(), name) == valid.end())
      throw stages.error("ringing", "there is no signal '" + name + "' in [output.signals]" + suggestion(name, valid));
}

} // namespace

/// Keys of [output.stages].
const std::vector<Key> &stage_keys()
{
  static const std::vector<Key> keys = {
      key::plain("borders", Key::Form::texts,
                 "events that end a stage, in order: `\"limiter\"`, the first event of that object after the previous "
                 "boundary, or `\"cylinder.braking_ends\"`, the first event of that kind"),
      key::plain("names", Key::Form::texts, "names of the stages, one more than `borders`")
          .by_default("stage 1, stage 2, ..."),
      key::plain("ringing", Key::Form::texts, "signals from which modes and damping of the last stage are identified")
          .by_default("none"),
      key::plain("modes", Key::Form::whole, "maximum number of identified modes; the strongest are listed")
          .by_default(&StageRequest::modes)};
  return keys;
}

/// [output.stages]: names and border events of the stages of the run, and the signals whose ringing in the last stage
/// is analysed. The signals and switches of `result` may be read later: the borders are searched after the run.
/// @throws std::invalid_argument for numbers of names and borders that do not fit, and unknown signals
void read_stages(const SceneTable &output, Scene &scene)
{
  if (!output.has("stages"))
    return;
  const SceneTable stages = output.table("stages").declared(stage_keys());
  stages.fill(scene.stages);
  scene.stages.place   = stages.place();
  scene.stages.borders = stages.texts("borders");
  if (scene.stages.borders.empty())
    throw stages.error("borders", "is empty; name the events that end a stage, such as a switch");
  scene.stages.names = stage_names(stages, scene.stages.borders.size());
  if (stages.has("ringing"))
    scene.stages.ringing = stages.texts("ringing");
  require_signals(stages, scene);
  constexpr int most_ringing_modes = 12; // the matrix pencil of noisy rows resolves no more
  if (scene.stages.modes < 1 || scene.stages.modes > most_ringing_modes)
    throw stages.error("modes", "needs a number from 1 to " + std::to_string(most_ringing_modes));
}

void request_stresses(const SceneTable &asking, Scene &scene)
{
  const std::string remedy = "; remove [" + asking.path() + "]";
  switch (scene.frame.source)
  {
  case FrameSource::none:
    throw asking.error("there is no frame, so there are no stresses" + remedy);
  case FrameSource::matrices:
    throw asking.error("a frame given by matrices has no elements, so stresses cannot be computed; give it by 'cad'");
  case FrameSource::reduced_file:
    break; // known when it is read
  case FrameSource::parts:
  case FrameSource::geometry:
    if (!scene.reduction.reduces())
      throw asking.error(std::string("stresses need a reduced frame; remove reduction.method = \"") +
                         (scene.reduction.superposition ? "modal" : "none") + "\"");
  }
  scene.frame.geometry.stress = true;
  for (coupling::FramePart &part : scene.frame.parts.parts)
    part.geometry.stress = true;
}

namespace
{

constexpr const char *the_stress = "stress"; ///< the stress itself, in addition to names of signals

void read_instants(const SceneTable &stress, Scene &scene)
{
  if (!stress.has("at"))
    return;
  coupling::RunOptions &run = scene.run.options;
  run.states.at = stress.is_array("at") ? stress.numbers("at", kind::time) : std::vector<double>{stress.value("at")};
  for (const double t : run.states.at)
    if (scene.run.given && !(t >= run.begin && t <= run.end))
      throw stress.error("at", "the time " + seconds(t) + " is outside the run, which is from " + seconds(run.begin) +
                                   " to " + seconds(run.end));
  std::sort(run.states.at.begin(), run.states.at.end());
  for (std::size_t i = 0; i < run.states.at.size(); ++i)
    scene.stress.instants.push_back({"", StressInstant::time, static_cast<int>(i)});
}

void read_extremes(const SceneTable &stress, const std::string &key, Scene &scene)
{
  if (!stress.has(key))
    return;
  std::vector<std::string> valid;
  for (const SignalRequest &signal : scene.signals)
    valid.push_back(signal.name);
  for (const std::string &name : stress.texts(key))
  {
    const auto signal = std::find(valid.begin(), valid.end(), name);
    if (key == "largest" && name == the_stress)
    {
      if (signal != valid.end())
        throw stress.error(key, "'stress' means the stress itself, but a signal also has this name; rename the signal");
      scene.stress.instants.push_back({"largest stress", StressInstant::largest_stress, 0});
      continue;
    }
    if (signal == valid.end())
      throw stress.error(key, "there is no signal '" + name + "' in [output.signals]" + suggestion(name, valid) +
                                  (key == "largest" ? "; the stress itself is 'stress'" : ""));
    auto &extremes = scene.run.options.states.extremes;
    scene.stress.instants.push_back(
        {key + " " + name, StressInstant::extreme_of_signal, static_cast<int>(extremes.size())});
    extremes.push_back({static_cast<int>(signal - valid.begin()), key == "largest"});
  }
}

} // namespace

/// Keys of [output.stress].
const std::vector<Key> &stress_keys()
{
  static const std::vector<Key> keys = {
      key::number("at", kind::time, "instant").also({Key::Form::numbers}).by_default("none"),
      key::plain("largest", Key::Form::texts,
                 "signals at whose maximum stresses are written; `\"stress\"`: at the time of the largest "
                 "equivalent stress, see `step`")
          .by_default("`\"stress\"` if no other instant is requested"),
      key::plain("smallest", Key::Form::texts, "signals at whose minimum stresses are written").by_default("none"),
      key::number("step", kind::time, "interval of the states that are searched for the largest stress")
          .above_zero()
          .by_default("`output.step`, or 1/5000 of the run if that is longer")};
  return keys;
}

/// [output.stress]: the instants at which stresses are computed. Requests stresses from the frame and states from the
/// run; `result` already has its frame, run and signals.
/// @throws std::invalid_argument for a frame without stresses, instants outside the run and unknown signals.
void read_stress(const SceneTable &output, Scene &scene)
{
  if (!output.has("stress"))
    return;
  const SceneTable stress = output.table("stress").declared(stress_keys());
  request_stresses(stress, scene);
  scene.stress.given = true;
  scene.stress.place = stress.place();
  read_instants(stress, scene);
  read_extremes(stress, "largest", scene);
  read_extremes(stress, "smallest", scene);
  if (scene.stress.instants.empty())
    scene.stress.instants.push_back({"largest stress", StressInstant::largest_stress, 0});
  coupling::RunOptions &run         = scene.run.options;
  constexpr double      most_states = 5000.; // by default: some per pixel of a chart, 40 MB at 1000 coordinates
  const double step = std::max(scene.run.given ? coupling::output_step(run) : 0., (run.end - run.begin) / most_states);
  const double chosen = stress.value_or("step", step);
  const bool   search = std::any_of(scene.stress.instants.begin(), scene.stress.instants.end(),
                                    [](const auto &instant) { return instant.when == StressInstant::largest_stress; });
  run.states.step     = search ? chosen : 0.;
}

const std::vector<Key> &output_keys()
{
  static const std::vector<Key> keys = {
      key::map("signals", kind::number, {},
               "`{ F_P = \"rod.force\", x1 = \"-frame.crown.uz\" }`; a leading minus changes the sign. With `{ Q4 = { "
               "signal = \"cylinder.force\", from = \"limiter\" } }` extremes are evaluated from the first event of "
               "that name, "
               "including the value after a jump. A list of paths is also accepted; the paths are then the names")
          .also({Key::Form::texts})
          .by_default("none"),
      key::number("step", kind::time,
                  "interval between rows of `history.csv`; rows between steps come from the dense output")
          .above_zero()
          .by_default("the fixed step; with a tolerance 1/2000 of the run")
          .into(&coupling::RunOptions::output_step),
      key::number("from", kind::time,
                  "start of the window for extremes, key numbers and spectra; or `\"last period\"`, [see "
                  "there](#a-window-for-results)")
          .also({Key::Form::text})
          .by_default("the start of the run"),
      key::number("picture_step", kind::time, "interval between pictures of the motion; 0: none")
          .from_zero()
          .by_default("1/100 of the run")
          .into(&coupling::RunOptions::picture_step),
      key::truth("allow_large", coupling::RunOptions().allow_large,
                 "`true` removes two limits: more than 1 GB of history and states, or 20 000 pictures, is an error; "
                 "`motion/` gets at most 100 pictures (fewer to stay within 20 MB, but at least 24)")
          .into(&coupling::RunOptions::allow_large),
      key::table("stress", {}, "stresses, [see there](#stress)").by_default("none"),
      key::table("stages", {}, "parts of the run between events, [see there](#stages)").by_default("none")};
  return keys;
}

const std::vector<Key> &watched_signal_keys()
{
  static const std::vector<Key> keys = {key::plain("signal", Key::Form::text, "path of the signal, `\"rod.force\"`"),
                                        key::plain("from", Key::Form::text, "event from which extremes are evaluated")};
  return keys;
}

static void read_window(const SceneTable &table, Scene &result)
{
  const std::string     last_period = "last period", text = table.is_text("from") ? table.text("from") : "";
  coupling::RunOptions &run = result.run.options;
  result.run.last_period    = text == last_period;
  if (result.run.last_period)
    return;
  if (!nearest_name(text, {last_period}).empty())
    throw table.error("from", "there is no '" + text + "'; did you mean '" + last_period + "'?");
  run.from = table.value_or("from", run.from);
  if (table.has("from") && run.from < run.begin)
    throw table.error("from", "is " + short_text(run.from) + " s, before the start of the run at " +
                                  short_text(run.begin) +
                                  " s; give a time within the run, or omit the key for the whole run");
  if (table.has("from") && result.run.given && run.from >= run.end)
    throw table.error("from",
                      "is " + short_text(run.from) + " s; it must be before run.end = " + short_text(run.end) + " s");
}

/// Arguments of functions may be other signals, by their name.
static void name_arguments(Scene &result)
{
  for (SignalRequest &computed : result.signals)
    for (std::string &argument : computed.of)
      for (const SignalRequest &other : result.signals)
        if (!other.user && other.name == argument)
        {
          argument = other.path;
          break;
        }
}

void read_output(const SceneTable &scene, Scene &result)
{
  coupling::RunOptions &run = result.run.options;
  // A hundred pictures by default: enough for a film, little enough for a disk.
  run.picture_step = (run.end - run.begin) / 100.;
  if (!scene.has("output"))
    return;
  const SceneTable table = scene.table("output").declared(output_keys());
  table.fill(run);
  read_window(table, result);
  if (table.is_array("signals"))
    for (const auto &path : table.texts("signals"))
    {
      for (const SignalRequest &other : result.signals)
        if (other.name == path)
          throw table.error("signals", "'" + path + "' is a duplicate in the list");
      result.signals.push_back({path, path, table.place("signals"), ""});
    }
  else if (const auto signals = table.optional_table("signals"))
    for (const auto &name : signals->keys())
    {
      if (name.empty() || name.find_first_of(",\"\n[]") != std::string::npos || name == "t")
        throw signals->error(name, "is not a valid name for a signal: it heads a column of history.csv, so it must not "
                                   "be 't' or contain commas, quotes or brackets");
      if (const auto user = signals->user_value(name))
      {
        if (!user->signal)
          throw signals->error(name, "is a force law; a function of signals is added by Scene.signal(...)");
        result.signals.push_back({name, user->mark, signals->place(name), "", user->signal, user->signal->of});
        continue;
      }
      if (!signals->is_table(name))
      {
        result.signals.push_back({name, signals->text(name), signals->place(name), ""});
        continue;
      }
      const auto watched = signals->table(name).declared(watched_signal_keys());
      result.signals.push_back({name, watched.text("signal"), signals->place(name), watched.text("from")});
    }
  name_arguments(result);
  read_stress(table, result);
  read_stages(table, result);
}

} // namespace gestell::apps
