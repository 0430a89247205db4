#include "apps/scene/read/read_stages.h"

#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr int most_ringing_modes = 12;

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
                                    " part the run into " + std::to_string(n_borders + 1) +
                                    " stages; give one name more than borders");
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

const std::vector<Key> &stage_keys()
{
  static const std::vector<Key> keys = {
      key::plain("borders", Key::Form::texts,
                 "events that end a stage, in their order: `\"limiter\"`, the first event of that object behind the "
                 "border before, or `\"cylinder.braking_ends\"`, the first of that kind"),
      key::plain("names", Key::Form::texts, "of the stages, one more than borders").by_default("stage 1, stage 2, ..."),
      key::plain("ringing", Key::Form::texts,
                 "names of signals in which modes and damping of the last stage are looked for")
          .by_default("none"),
      key::plain("modes", Key::Form::whole, "of them that are told, at most, the strongest")
          .by_default(StageRequest().modes)};
  return keys;
}

void read_stages(const SceneTable &output, Scene &scene)
{
  if (!output.has("stages"))
    return;
  const SceneTable stages = output.table("stages").declared(stage_keys());
  scene.stages.place      = stages.place();
  scene.stages.borders    = stages.texts("borders");
  if (scene.stages.borders.empty())
    throw stages.error("borders", "is empty; name the events that end a stage, such as a switch");
  scene.stages.names = stage_names(stages, scene.stages.borders.size());
  if (stages.has("ringing"))
    scene.stages.ringing = stages.texts("ringing");
  require_signals(stages, scene);
  scene.stages.modes = stages.whole("modes");
  if (scene.stages.modes < 1 || scene.stages.modes > most_ringing_modes)
    throw stages.error("modes", "needs a number between 1 and " + std::to_string(most_ringing_modes));
}

} // namespace gestell::apps
