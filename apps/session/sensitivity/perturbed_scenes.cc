#include "apps/session/sensitivity/perturbed_scenes.h"

#include "apps/scene/build/result_window.h"
#include "apps/scene/file/parameters.h"
#include "apps/session/joint_opening.h"
#include "coupling/frame/frame_recipe.h"
#include "coupling/machine/own_modes.h"
#include "coupling/sensitivity/frame_derivative.h"
#include "coupling/sensitivity/motion_linearisation.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

[[noreturn]] void refuse(const VariedKey &key, const std::string &what)
{
  throw std::invalid_argument("--sensitivities " + key.reported.key + ": " + what);
}

bool reduces(const Scene &scene)
{
  return frame_path(scene) == FramePath::reduce;
}

/// Whether its frames differ in what is meshed.
bool meshed_anew(const Scene &a, const Scene &b)
{
  const auto changes = coupling::differences(frame_origin(a).recipe, frame_origin(b).recipe);
  return std::any_of(changes.begin(), changes.end(),
                     [](const coupling::Difference &change)
                     {
                       for (const std::string part : {"source", "mesh", "unit", "surface"})
                         if (change.name.find(part) != std::string::npos)
                           return true;
                       return false;
                     });
}

/// Scenes with one entry at other values.
class VariedScene
{
public:
  VariedScene(const Variant &file, VariedKey &key) : file_(file), key_(key) {}

  /// The scene at the value of the key plus `by` steps.
  Scene at(double by) const
  {
    const Variant varied = file_.with(key_.overridden(by));
    try
    {
      return varied.scene();
    }
    catch (const IdleParameter &)
    {
      throw IdleParameter(
          "--sensitivities " + key_.reported.key +
          ": no value of the scene depends on this parameter, so all its derivatives are zero; remove it");
    }
    catch (const std::invalid_argument &refused)
    {
      std::ostringstream text;
      text << "the scene is invalid at a value " << 1e-4 * std::abs(by)
           << " % away, so this key has no derivative: " << refused.what();
      refuse(key_, text.str());
    }
  }
  VariedKey &key() const { return key_; }

private:
  const Variant &file_;
  VariedKey     &key_;
};

/// The frame of the scene in the coordinates in which a machine has it.
coupling::ReducedFrame frame_of_machine(const Scene &scene, const coupling::Progress &progress)
{
  coupling::ReducedFrame frame = reduced_frame(scene, progress).frame;
  coupling::turn_to_own_modes(frame);
  return frame;
}

/// The frame with as many modes as another has.
coupling::ReducedFrame frame_with_modes_of(const coupling::ReducedFrame &other, Scene scene,
                                           const coupling::Progress &progress)
{
  const auto after = other.M.rows() - other.n_interface;
  if (scene.frame.source != FrameSource::parts && scene.reduction.options.n_modes < 0 && after == other.n_fixed_modes)
    scene.reduction.options.n_modes = other.n_fixed_modes;
  return frame_of_machine(scene, progress);
}

/// Derivative of the frame with respect to a key that changes it: a quotient of two cached frames.
std::optional<coupling::FrameDerivative> derivative_of_frame(const VariedScene &varied, const Scene &scene,
                                                             const coupling::ReducedFrame &frame,
                                                             const coupling::Progress &progress, std::string &warning)
{
  const Scene near = varied.at(1.);
  if (!reduces(scene) || same_frame(near, scene))
    return {};
  VariedKey       &key         = varied.key();
  const bool       anew        = meshed_anew(near, scene);
  constexpr double of_matrices = 1e-3; // relative change of the parameter, for frames on equal meshes
  constexpr double of_meshes   = 5e-2; // for remeshed frames: the scatter of the meshes is smaller
  const double     steps       = (anew ? of_meshes : of_matrices) * std::abs(key.reported.value) / key.step;
  try
  {
    const auto below = frame_with_modes_of(frame, varied.at(-steps), progress),
               above = frame_with_modes_of(frame, varied.at(steps), progress);
    // a study leaves out the skin, by which modes are recognised
    auto derivative = frame.points.empty() ? coupling::frame_derivative(frame_of_machine(scene, progress), below, above,
                                                                        steps * key.step)
                                           : coupling::frame_derivative(frame, below, above, steps * key.step);
    key.reported.frame = "differences of two reductions at " + percent(anew ? of_meshes : of_matrices) +
                         (anew ? " above and below, each meshed again" : " above and below");
    constexpr double rough = 0.05; // of a difference of frames: larger errors are reported
    if (derivative.curvature > rough)
      warning = "derivatives by " + key.reported.key + " come from " + key.reported.frame +
                "; their mean differs from the unchanged frame by " + percent(derivative.curvature, 2) +
                " of the difference between them, so the derivatives may have this error" +
                (anew ? ": a finer mesh reduces the scatter" : "");
    return derivative;
  }
  catch (const std::runtime_error &failed)
  {
    refuse(key, "the frame cannot be reduced at another value: " + std::string(failed.what()));
  }
  catch (const std::invalid_argument &refused)
  {
    const std::string text = refused.what();
    if (text.rfind("--sensitivities", 0) == 0)
      throw;
    refuse(key, text);
  }
}

/// Whether two machines have the same coordinates, measures, joints and elements; modes of a moved frame are named as
/// coordinates.
void require_same_structure(const coupling::Machine &machine, const coupling::Machine &twin, const VariedKey &key)
{
  bool same = machine.size() == twin.size() &&
              machine.forces().directions().cols() == twin.forces().directions().cols() &&
              machine.joints().n_rows() == twin.joints().n_rows() &&
              machine.events().save_history().size() == twin.events().save_history().size();
  for (int i = 0; same && i < machine.size() && key.reported.frame.empty(); ++i)
    same = machine.coordinate_name(i) == twin.coordinate_name(i);
  if (!same)
    refuse(key, "another value changes the coordinates, elements or joints of the machine, so there is no derivative; "
                "compare two runs with --set " +
                    key.reported.key + "=...");
}

PreparedScene twin_of(const VariedScene &varied, const coupling::ReducedFrame *frame,
                      const coupling::FrameDerivative *of_frame, double by)
{
  Scene scene = varied.at(by);
  try
  {
    const auto moved = of_frame ? coupling::moved(*frame, *of_frame, by * varied.key().step) : coupling::ReducedFrame();
    return prepared_scene(std::move(scene), of_frame ? &moved : frame);
  }
  catch (const std::invalid_argument &refused)
  {
    refuse(varied.key(), "the machine is invalid at a value a millionth away, so this key has no derivative: " +
                             std::string(refused.what()));
  }
}

coupling::MachineTwin reported(const PreparedScene &of)
{
  coupling::MachineTwin twin;
  twin.machine = &of.prepared->machine;
  twin.initial = prepare_start(*of.scene, *of.prepared);
  twin.signals = with_normal_forces(*of.scene, of.prepared->machine, scene_signals(*of.scene, of.prepared->machine));
  twin.end     = of.scene->run.options.end;
  twin.from    = result_window(*of.scene, of.prepared->machine, twin.initial);
  return twin;
}

void add_twins(const Variant &file, const Scene &scene, const PreparedMachine &prepared,
               const coupling::ReducedFrame *frame, const coupling::Progress &progress, VariedKey &key,
               PerturbedScenes &made)
{
  const VariedScene varied(file, key);
  std::string       warning;
  const auto        of_frame =
      frame ? derivative_of_frame(varied, scene, *prepared.machine.model().reduced_frame(), progress, warning)
                   : std::nullopt;
  PreparedScene below = twin_of(varied, frame, of_frame ? &*of_frame : nullptr, -1.),
                above = twin_of(varied, frame, of_frame ? &*of_frame : nullptr, 1.);
  for (const PreparedScene *twin : {&below, &above})
    require_same_structure(prepared.machine, twin->prepared->machine, key);
  coupling::ParameterTwins twins{key.reported.key, key.reported.unit, key.reported.value,
                                 key.step,         reported(below),   reported(above)};
  made.scenes.push_back(std::move(below));
  made.scenes.push_back(std::move(above));
  made.twins.push_back(std::move(twins));
  if (!warning.empty())
    made.warnings.push_back(std::move(warning));
}

} // namespace

PerturbedScenes perturbed_scenes(const Variant &file, const Scene &scene, PreparedMachine &prepared,
                                 std::vector<VariedKey> &keys, std::vector<std::string> *left_out,
                                 const coupling::Progress &progress)
{
  if (prepared.companion)
    throw std::invalid_argument("--sensitivities: not available with reduction.method = \"modal\" or an unreduced "
                                "frame; use reduction.method = \"craig-bampton\"");
  if (scene.start.periodic)
    throw std::invalid_argument(
        "--sensitivities: not available with start.rule = \"periodic\"; use another rule, or give the initial state");
  coupling::require_variational(prepared.machine);
  std::optional<coupling::ReducedFrame> frame;
  if (on_reduced_frame(scene))
    frame = without_pictures(*prepared.machine.model().reduced_frame());
  PerturbedScenes        made;
  std::vector<VariedKey> kept;
  std::string            idle;
  for (VariedKey &key : keys)
    try
    {
      add_twins(file, scene, prepared, frame ? &*frame : nullptr, progress, key, made);
      kept.push_back(key);
    }
    catch (const IdleParameter &)
    {
      if (!left_out)
        throw;
      idle += (idle.empty() ? "" : ", ") + key.reported.key;
    }
    catch (const std::invalid_argument &none)
    {
      if (!left_out)
        throw;
      left_out->push_back(none.what());
    }
  if (!idle.empty())
    left_out->push_back("--sensitivities all omits parameters on which no value of the scene depends: " + idle);
  if (kept.empty())
    throw std::invalid_argument("--sensitivities all: no parameter of this scene has a derivative: " +
                                left_out->front());
  keys = std::move(kept);
  return made;
}

} // namespace gestell::apps
