#include "apps/session/sensitivity/scene_twins.h"

#include "apps/scene/file/scene_override.h"
#include "apps/session/joint_opening.h"
#include "coupling/frame/frame_recipe.h"
#include "coupling/sensitivity/motion_linearisation.h"

#include <stdexcept>

namespace gestell::apps
{

namespace
{
/// What a machine needs of its frame, without what is only drawn or told.
coupling::ReducedFrame without_pictures(const coupling::ReducedFrame &frame)
{
  coupling::ReducedFrame plain = frame;
  plain.points                 = {};
  plain.triangles              = {};
  plain.displacement           = {};
  plain.stress                 = {};
  return plain;
}

[[noreturn]] void refuse(const VariedKey &key, const std::string &what)
{
  throw std::invalid_argument("--sensitivities " + key.told.key + ": " + what);
}

bool reduces(const Scene &scene)
{
  return frame_path(scene) == FramePath::reduce;
}

bool same_frame(const Scene &a, const Scene &b)
{
  return !reduces(a) || coupling::content_key(frame_origin(a).recipe) == coupling::content_key(frame_origin(b).recipe);
}

PreparedMachine machine_of(const Scene &twin, const Scene &scene, const coupling::ReducedFrame *frame, VariedKey &key)
{
  if (!frame || !same_frame(twin, scene))
  {
    if (reduces(twin))
      refuse(key, "this entry changes the reduced frame, whose derivative is not built; compare two runs with --set " +
                      key.told.key + "=... (each frame is reduced once and kept)");
    return prepare_machine(twin);
  }
  return prepare_machine_on(twin, *frame);
}

/// Whether two machines have the same coordinates, measures, joints and elements.
void require_same_structure(const coupling::Machine &machine, const coupling::Machine &twin, const VariedKey &key)
{
  bool same = machine.size() == twin.size() &&
              machine.forces().directions().cols() == twin.forces().directions().cols() &&
              machine.joints().n_rows() == twin.joints().n_rows() &&
              machine.events().save_history().size() == twin.events().save_history().size();
  for (int i = 0; same && i < machine.size(); ++i)
    same = machine.coordinate_name(i) == twin.coordinate_name(i);
  if (!same)
    refuse(key, "another value makes another machine, with other coordinates, elements or joints; a run has no "
                "derivative by it. Compare two runs with --set " +
                    key.told.key + "=...");
}

SceneTwin twin_of(const SceneNode &root, const std::string &path, fem::Scripts scripts, const Scene &scene,
                  const coupling::ReducedFrame *frame, VariedKey &key, double sign)
{
  SceneNode varied = root;
  apply_override(varied, key.overridden(sign));
  SceneTwin twin;
  try
  {
    twin.scene    = std::make_unique<Scene>(read_scene(varied, path, scripts));
    twin.prepared = std::make_unique<PreparedMachine>(machine_of(*twin.scene, scene, frame, key));
  }
  catch (const std::invalid_argument &refused)
  {
    const std::string text = refused.what();
    if (text.rfind("--sensitivities", 0) == 0)
      throw;
    refuse(key, "the scene is refused at a value a millionth away, so that this entry has no derivative: " + text);
  }
  return twin;
}

coupling::MachineTwin told(const SceneTwin &of)
{
  coupling::MachineTwin twin;
  twin.machine = &of.prepared->machine;
  twin.initial = prepare_start(*of.scene, *of.prepared);
  twin.signals = with_normal_forces(*of.scene, of.prepared->machine, scene_signals(*of.scene, of.prepared->machine));
  twin.end     = of.scene->run.options.end;
  return twin;
}

} // namespace

SceneTwins scene_twins(const SceneNode &root, const std::string &path, fem::Scripts scripts, const Scene &scene,
                       PreparedMachine &prepared, std::vector<VariedKey> &keys)
{
  if (prepared.companion)
    throw std::invalid_argument("--sensitivities: a machine in modes (reduction.method = \"modal\") or on an unreduced "
                                "frame has no derivatives here; take reduction.method = \"craig-bampton\"");
  if (scene.start.periodic)
    throw std::invalid_argument("--sensitivities: start.rule = \"periodic\" has no derivative here; take the rule "
                                "\"steady\" or \"equilibrium\", or give the start");
  coupling::require_variational(prepared.machine);
  std::optional<coupling::ReducedFrame> frame;
  if (frame_path(scene) == FramePath::reduce || frame_path(scene) == FramePath::from_file)
    frame = without_pictures(*prepared.machine.model().reduced_frame());
  SceneTwins made;
  for (VariedKey &key : keys)
  {
    for (const double sign : {-1., 1.})
    {
      made.scenes.push_back(twin_of(root, path, scripts, scene, frame ? &*frame : nullptr, key, sign));
      require_same_structure(prepared.machine, made.scenes.back().prepared->machine, key);
    }
    coupling::ParameterTwins twins{key.told.key, key.told.unit, key.told.value, key.step, {}, {}};
    twins.minus = told(made.scenes[made.scenes.size() - 2]);
    twins.plus  = told(made.scenes.back());
    made.twins.push_back(std::move(twins));
  }
  return made;
}

} // namespace gestell::apps
