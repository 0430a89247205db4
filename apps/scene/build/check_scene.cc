#include "apps/scene/build/build_machine.h"
#include "apps/scene/build/far_places.h"
#include "apps/scene/build/free_bodies.h"
#include "apps/scene/build/placeholder_frame.h"
#include "apps/scene/build/result_window.h"
#include "apps/scene/build/scene_magnitudes.h"
#include "apps/scene/build/superposed_machine.h"
#include "coupling/frame/reduced_frame_file.h"
#include "coupling/integration/step/law_values.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/machine/configuration/sticking_conflict.h"

#include <algorithm>

namespace gestell::apps
{
coupling::Machine machine_to_check(const Scene &scene)
{
  const FramePath path = frame_path(scene);
  if (path == FramePath::none || path == FramePath::dense)
    return build_machine(scene);
  if (path == FramePath::from_file)
    return build_machine(scene, coupling::read_reduced_frame(scene.frame.reduced_file));
  return build_machine(scene, placeholder_frame(scene));
}

bool places_known(const Scene &scene)
{
  const auto all_known = [](const std::vector<fem::InterfaceSpecification> &interfaces)
  {
    return std::all_of(interfaces.begin(), interfaces.end(),
                       [](const fem::InterfaceSpecification &interface) { return interface.position.has_value(); });
  };
  switch (scene.frame.source)
  {
  case FrameSource::geometry:
    return all_known(scene.frame.geometry.interfaces);
  case FrameSource::parts:
    return all_known(coupling::interfaces_in_frame(scene.frame.parts));
  default:
    return true;
  }
}

std::vector<std::string> check_scene(const Scene &scene)
{
  auto machine = machine_to_check(scene);
  scene_signals(scene, machine);
  if (scene.reduction.superposition)
  {
    refuse_turning(scene);
    coupling::check_superposition(machine, scene.reduction.options.place);
  }
  if (coupling::has_joints(machine) && !places_known(scene))
    check_start_names(scene, machine);
  else
  {
    if (!coupling::has_joints(machine) || scene.start.rule == StartRule::given) // static states need the frame itself
      modes_configuration(scene, machine);
    if (scene.start.rule == StartRule::given)
      initial_state(scene, machine);
  }
  for (const auto &[name, angle] : scene.start.steady.angles)
    (void)angle, machine.model().body(name);
  auto       warnings = scene.warnings;
  const auto add      = [&](const std::vector<std::string> &more)
  { warnings.insert(warnings.end(), more.begin(), more.end()); };
  add(idle_bodies(scene, machine.model()));
  if (places_known(scene))
  {
    const FramePath path   = frame_path(scene);
    const bool      exists = path == FramePath::none || path == FramePath::dense || path == FramePath::from_file;
    add(remote_joints(scene, machine.model()));
    warn_of_magnitudes(scene_magnitudes(scene, machine, exists ? Masses::known : Masses::of_stand_in), warnings);
  }
  add(places_far_from_faces(scene, machine.model()));
  if (!scene.run.given)
    return warnings;
  try
  {
    coupling::check_run(machine, scene.run.options, scene.signals.size());
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(scene.run.place + ": " + error.what());
  }
  return warnings;
}

void require_free_motion(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &initial)
{
  const coupling::StickingConflict conflict = coupling::sticking_conflict(machine, initial);
  if (!conflict.element.empty())
    throw std::invalid_argument(scene.element_places.at(conflict.element) + ": " + conflict.words);
  coupling::LocalState local;
  local.resize(machine);
  machine.events().follow_history(true); // sticking_conflict() began it: kinks have their sides
  machine.gather(initial.t, initial.q, initial.v, Eigen::VectorXd::Zero(machine.size()), local);
  const coupling::LawWithoutValue none = coupling::law_without_value(machine, local);
  machine.events().follow_history(false);
  if (!none.element.empty())
  {
    const auto place = scene.element_places.find(none.element);
    throw std::invalid_argument((place == scene.element_places.end() ? scene.run.place : place->second) + ": " +
                                none.words);
  }
}

namespace
{
void try_start(const Scene &scene, coupling::Machine &machine, const coupling::InitialState &initial)
{
  try
  {
    coupling::try_start(machine, initial, scene.run.options);
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(scene.run.place + ": " + error.what());
  }
}
} // namespace

void check_start(const Scene &scene)
{
  const FramePath path  = frame_path(scene);
  const bool      known = path == FramePath::none || path == FramePath::dense || path == FramePath::from_file;
  if (!scene.run.given || (!known && scene.start.rule != StartRule::given))
    return;
  auto machine = machine_to_check(scene);
  if (coupling::has_joints(machine) && !places_known(scene))
    return;
  try
  {
    const coupling::InitialState initial = initial_state(scene, machine);
    require_free_motion(scene, machine, initial);
    result_window(scene, machine, initial);
    if (known)
      try_start(scene, machine, initial);
  }
  catch (const coupling::ConvergenceFailure &failure)
  {
    throw against_start(scene, std::string("no initial state: ") + failure.what());
  }
}

/// Nothing where a law has no stiffness in that configuration: a run need not come there.
std::vector<coupling::Mode> modes_if_any(const Scene &scene, const coupling::Machine &machine, const Eigen::VectorXd &q)
{
  try
  {
    return coupling::coupled_modes(machine, q, scene.modes.open, machine.size());
  }
  catch (const std::invalid_argument &)
  {
    return {};
  }
}

std::string floating_frame(const Scene &scene)
{
  const FramePath path   = frame_path(scene);
  const bool      exists = path == FramePath::dense || path == FramePath::from_file;
  if (!scene.run.given || path == FramePath::none || !places_known(scene))
    return "";
  auto machine = exists ? machine_to_check(scene) : build_machine(scene, rigid_stand_in(scene));
  if (!may_float(*machine.model().reduced_frame()))
    return "";
  if (coupling::has_joints(machine) && scene.start.rule != StartRule::given) // such a start is found with the frame
    return "";
  try
  {
    const Eigen::VectorXd q = modes_configuration(scene, machine);
    return free_frame(scene, machine.model(), modes_if_any(scene, machine, q));
  }
  catch (const coupling::ConvergenceFailure &)
  {
    return ""; // check_start() reports machines that cannot move
  }
}

void require_run(const Scene &scene)
{
  if (!scene.run.given)
    throw std::invalid_argument(
        scene.run.place + ": there is no [run]; it needs 'end' and 'step' (or 'tolerance'), such as end = \"0.5 s\", "
                          "step = \"10 us\"");
}

} // namespace gestell::apps
