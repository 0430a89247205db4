#include "apps/scene/build_machine.h"

namespace gestell::apps
{
namespace
{

/// A frame that has the interfaces and outputs of the scene and no physics.
coupling::ReducedFrame stand_in_frame(const fem::FrameSpecification &specification)
{
  coupling::ReducedFrame frame;
  const int              n = 6 * specification.interfaces.size();
  frame.M = frame.C       = Eigen::MatrixXd::Identity(n, n);
  frame.B                 = Eigen::MatrixXd::Zero(n, n);
  frame.n_interface       = n;
  frame.translations_load = Eigen::MatrixXd::Zero(n, 3);
  for (const auto &interface : specification.interfaces)
  {
    fem::Interface own;
    own.name     = interface.name;
    own.position = interface.position.value_or(fem::Vector3{});
    for (int i = 0; i < 6; ++i)
      own.coordinate[i] = 6 * frame.interfaces.size() + i;
    frame.interfaces.push_back(own);
  }
  const auto add_output = [&](const std::string &name) {
    frame.outputs.push_back({name, "N", Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)});
  };
  for (const auto &cut : specification.cuts)
    add_output("cut." + cut.name);
  for (const auto &support : specification.supports)
    for (const std::string direction : {"x", "y", "z"})
      add_output("support." + support.name + "." + direction);
  return frame;
}

} // namespace

void check_scene(const Scene &scene)
{
  const FrameSource source = scene.frame.source;
  if (source == FrameSource::reduced_file)
    return;
  auto machine = source == FrameSource::geometry ? build_machine(scene, stand_in_frame(scene.frame.geometry))
                                                 : build_machine(scene);
  scene_signals(scene, machine);
  modes_configuration(scene, machine);
  if (scene.start.rule == StartRule::given)
    initial_state(scene, machine);
  for (const auto &[name, angle] : scene.start.steady.angles)
    (void)angle, machine.body(name);
}

void require_run(const Scene &scene)
{
  if (scene.run.options.step <= 0.)
    throw std::invalid_argument(scene.run.place +
                                ": there is no [run]; it needs 'end' and 'step', such as end = \"0.5 s\", "
                                "step = \"10 us\"");
  if (scene.signals.empty())
    throw std::invalid_argument(scene.run.place +
                                ": there are no signals to compute; name them in [output] signals = { x = "
                                "\"slide.displacement\" }");
}

} // namespace gestell::apps
