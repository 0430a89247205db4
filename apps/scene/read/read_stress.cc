#include "apps/scene/read/read_stress.h"

#include "apps/scene/read/read_run.h"
#include "fem/values/nearest_name.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

constexpr const char *the_stress  = "stress"; ///< itself, beside the names of signals
constexpr double      most_states = 5000.;    ///< by default

void require_stresses(const SceneTable &stress, const Scene &scene)
{
  switch (scene.frame.source)
  {
  case FrameSource::none:
    throw stress.error("there is no frame, so that there are no stresses; leave [output.stress] out");
  case FrameSource::matrices:
    throw stress.error(
        "a frame given by matrices has no material and no elements, so that there are no stresses; give it by 'cad'");
  case FrameSource::parts:
    throw stress.error("stresses of a frame of parts are not computed; leave [output.stress] out, or draw the frame in "
                       "one piece, [frame] cad = ...");
  case FrameSource::reduced_file:
    break; // known when it is read
  case FrameSource::geometry:
    if (!scene.reduction.reduces())
      throw stress.error("stresses are recovered from the reduced frame; leave out reduction.method = \"none\"");
  }
}

void read_instants(const SceneTable &stress, Scene &scene)
{
  if (!stress.has("at"))
    return;
  coupling::RunOptions &run = scene.run.options;
  run.states.at = stress.is_array("at") ? stress.numbers("at", kind::time) : std::vector<double>{stress.value("at")};
  for (const double t : run.states.at)
    if (scene.run.given && !(t >= run.begin && t <= run.end))
      throw stress.error("at", "the instant " + seconds(t) + " lies outside the run, which goes from " +
                                   seconds(run.begin) + " to " + seconds(run.end));
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
        throw stress.error(key, "'stress' is the stress itself, but a signal has this name, too; rename the signal");
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

const std::vector<Key> &stress_keys()
{
  static const std::vector<Key> keys = {
      key::number("at", kind::time, "instant").also({Key::Form::numbers}).by_default("none"),
      key::plain(
          "largest", Key::Form::texts,
          "names of signals at whose largest value stresses are written; `\"stress\"`: when the equivalent stress "
          "itself is largest anywhere, see `step`")
          .by_default("`\"stress\"` if nothing else is asked for"),
      key::plain("smallest", Key::Form::texts, "names of signals, likewise").by_default("none"),
      key::number("step", kind::time, "between the states among which the largest stress is looked for")
          .above_zero()
          .by_default("`output.step`, or a five thousandth of the run if that is longer")};
  return keys;
}

void read_stress(const SceneTable &output, Scene &scene)
{
  if (!output.has("stress"))
    return;
  const SceneTable stress = output.table("stress").declared(stress_keys());
  require_stresses(stress, scene);
  scene.stress.given          = true;
  scene.stress.place          = stress.place();
  scene.frame.geometry.stress = true;
  read_instants(stress, scene);
  read_extremes(stress, "largest", scene);
  read_extremes(stress, "smallest", scene);
  if (scene.stress.instants.empty())
    scene.stress.instants.push_back({"largest stress", StressInstant::largest_stress, 0});
  coupling::RunOptions &run = scene.run.options;
  const double step = std::max(scene.run.given ? coupling::output_step(run) : 0., (run.end - run.begin) / most_states);
  const double chosen = stress.value_or("step", step);
  const bool   search = std::any_of(scene.stress.instants.begin(), scene.stress.instants.end(),
                                    [](const auto &instant) { return instant.when == StressInstant::largest_stress; });
  run.states.step     = search ? chosen : 0.;
}

} // namespace gestell::apps
