#include "apps/scene/build_machine.h"
#include "apps/scene/free_things.h"
#include "coupling/assembly.h"
#include "coupling/reduced_frame_file.h"
#include "coupling/sticking_conflict.h"

#include <algorithm>
#include <utility>

namespace gestell::apps
{
namespace
{

/// A frame that has these interfaces and outputs, and no physics.
coupling::ReducedFrame stand_in_frame(std::vector<fem::Interface> interfaces, const std::vector<std::string> &outputs)
{
  coupling::ReducedFrame frame;
  int                    n = 0;
  for (auto &interface : interfaces)
    for (int &coordinate : interface.coordinate)
      coordinate = coordinate < 0 ? -1 : n++;
  frame.M = frame.C       = Eigen::MatrixXd::Identity(n, n);
  frame.B                 = Eigen::MatrixXd::Zero(n, n);
  frame.n_interface       = n;
  frame.translations_load = Eigen::MatrixXd::Zero(n, 3);
  frame.interfaces        = std::move(interfaces);
  for (const auto &name : outputs)
    frame.outputs.push_back({name, "N", Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)});
  return frame;
}

coupling::ReducedFrame stand_in_for(const fem::FrameSpecification &specification)
{
  std::vector<fem::Interface> interfaces;
  for (const auto &interface : specification.interfaces)
  {
    interfaces.push_back(
        {interface.name, interface.position.value_or(fem::Vector3{}), {0, 1, 2, 3, 4, 5}, {1., 1., 1., 1., 1., 1.}});
    if (interface.coupling == fem::InterfaceCoupling::node)
      for (int rotation = fem::rx; rotation <= fem::rz; ++rotation)
        interfaces.back().coordinate[rotation] = -1;
  }
  std::vector<std::string> outputs;
  for (const auto &cut : specification.cuts)
    outputs.push_back("cut." + cut.name);
  for (const auto &support : specification.supports)
    for (const std::string direction : {"x", "y", "z"})
      outputs.push_back("support." + support.name + "." + direction);
  return stand_in_frame(interfaces, outputs);
}

/// Only the sizes of matrices that are too large to be looked at in no time.
coupling::ReducedFrame stand_in_for(const fem::FrameMatrices &matrices)
{
  std::vector<std::string> outputs;
  for (const auto &output : matrices.outputs)
    outputs.push_back(output.name);
  return stand_in_frame(matrices.interfaces, outputs);
}

coupling::Machine machine_to_check(const Scene &scene)
{
  const FramePath path = frame_path(scene);
  if (path == FramePath::none || path == FramePath::dense)
    return build_machine(scene);
  if (path == FramePath::from_file)
    return build_machine(scene, coupling::read_reduced_frame(scene.frame.reduced_file));
  return build_machine(scene, scene.frame.source == FrameSource::geometry ? stand_in_for(scene.frame.geometry)
                                                                          : stand_in_for(scene.frame.matrices));
}

} // namespace

bool places_known(const Scene &scene)
{
  const auto &interfaces = scene.frame.geometry.interfaces;
  return scene.frame.source != FrameSource::geometry ||
         std::all_of(interfaces.begin(), interfaces.end(),
                     [](const fem::InterfaceSpecification &interface) { return interface.position.has_value(); });
}

std::vector<std::string> check_scene(const Scene &scene)
{
  auto machine = machine_to_check(scene);
  scene_signals(scene, machine);
  if (coupling::has_joints(machine) && !places_known(scene))
    check_start_names(scene, machine);
  else
  {
    if (!coupling::has_joints(machine) || scene.start.rule == StartRule::given) // a static start needs the frame itself
      modes_configuration(scene, machine);
    if (scene.start.rule == StartRule::given)
      initial_state(scene, machine);
  }
  for (const auto &[name, angle] : scene.start.steady.angles)
    (void)angle, machine.body(name);
  auto warnings = idle_bodies(scene, machine);
  if (const auto remote = remote_joints(scene, machine); places_known(scene))
    warnings.insert(warnings.end(), remote.begin(), remote.end());
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
    if (known)
      try_start(scene, machine, initial);
  }
  catch (const coupling::ConvergenceFailure &failure)
  {
    throw against_start(scene, std::string("the machine does not start: ") + failure.what());
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
