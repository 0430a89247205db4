#include "apps/session/joint_opening.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

std::string path_of_normal_force(const coupling::FrameJoint &joint)
{
  return "frame." + coupling::joint_outputs(joint).back().first;
}

/// Index of the signal of a normal force; the scene's own signals come first.  @return -1 if there is none.
int number_of(const Scene &scene, const std::vector<coupling::Signal> &signals, const std::string &path)
{
  for (std::size_t i = 0; i < scene.signals.size(); ++i)
    if (scene.signals[i].path == path && scene.signals[i].from.empty())
      return int(i);
  const auto own =
      std::find_if(signals.begin(), signals.end(), [&](const coupling::Signal &signal) { return signal.name == path; });
  return own == signals.end() ? -1 : int(own - signals.begin());
}

std::string opening_text(const coupling::FrameJoint &joint, const coupling::SignalSummary &force)
{
  const DisplayUnit unit = display_unit("N", std::abs(force.min));
  return joint.place + ": this joint opens: its normal force drops to " + rounded(unit.factor * force.min) + " " +
         unit.unit + " at " + rounded(force.t_min) +
         " s, i.e. tension, which a contact cannot carry; results after the first opening are not valid. Increase the "
         "prestress of the tie rods, or reduce the load";
}

} // namespace

std::vector<coupling::Signal> with_normal_forces(const Scene &scene, const coupling::Machine &machine,
                                                 std::vector<coupling::Signal> signals)
{
  for (const coupling::FrameJoint &joint : scene.frame.parts.joints)
    if (const std::string path = path_of_normal_force(joint); joint.closes() && number_of(scene, signals, path) < 0)
      signals.push_back(machine.signal(path, path));
  return signals;
}

std::vector<std::string> opening_joints(const Scene &scene, const std::vector<coupling::Signal> &signals,
                                        const coupling::RunResult &run)
{
  std::vector<std::string> texts;
  for (const coupling::FrameJoint &joint : scene.frame.parts.joints)
    if (joint.closes())
      if (const int i = number_of(scene, signals, path_of_normal_force(joint));
          i >= 0 && std::size_t(i) < run.signals.size() && run.signals[std::size_t(i)].min < 0.)
        texts.push_back(opening_text(joint, run.signals[std::size_t(i)]));
  return texts;
}

} // namespace gestell::apps
