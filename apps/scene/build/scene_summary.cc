#include "apps/scene/build/scene_summary.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/build/damping_text.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace gestell::apps
{
namespace
{

using Words = std::vector<std::string>;

std::string joined(const Words &words)
{
  std::string line;
  for (const std::string &word : words)
    line += (line.empty() ? "" : ", ") + word;
  return line;
}

std::string coupling_text(const fem::InterfaceSpecification &interface)
{
  using Coupling = fem::InterfaceCoupling;
  switch (interface.coupling)
  {
  case Coupling::rigid:
    return "rigid on ";
  case Coupling::average:
    return "average over ";
  case Coupling::flexible:
    return "flexible on ";
  case Coupling::point:
    return "at a point of ";
  case Coupling::node:
    return "at a node of ";
  }
  return "";
}

Words interface_words(const std::vector<fem::InterfaceSpecification> &interfaces)
{
  Words words;
  for (const fem::InterfaceSpecification &interface : interfaces)
    words.push_back(
        "'" + interface.name + "'" +
        (interface.surfaces.empty() ? "" : " (" + coupling_text(interface) + listed(interface.surfaces) + ")"));
  return words;
}

Words support_words(const std::vector<fem::Support> &supports)
{
  Words words;
  for (const fem::Support &support : supports)
    words.push_back("'" + support.name +
                    (support.kind == fem::SupportKind::clamped ? "' (clamped)" : "' (on a foundation)"));
  return words;
}

std::string standing(const fem::FrameSpecification &frame)
{
  std::string text =
      frame.supports.empty() ? "without supports" : "supported by " + joined(support_words(frame.supports));
  Words masses;
  for (const fem::AttachedMass &mass : frame.masses)
    masses.push_back("'" + mass.name + "' (" + rounded(mass.mass) + " kg)");
  return text + (masses.empty() ? "" : ", with masses " + joined(masses));
}

std::string reduction_text(const Scene &scene)
{
  const coupling::ReductionOptions &o = scene.reduction.options;
  if (!scene.reduction.reduces())
    return scene.reduction.superposition ? "modal superposition" : "not reduced (" + scene.reduction.method + ")";
  return "reduced by " + o.method +
         (o.n_modes >= 0 ? " to " + count_text(std::size_t(o.n_modes), "mode") : " within " + percent(o.tolerance)) +
         (o.frequency > 0. ? " up to " + rounded(o.frequency) + " Hz" : "");
}

std::string frame_text(const Scene &scene)
{
  const FrameRequest &frame = scene.frame;
  switch (frame.source)
  {
  case FrameSource::none:
    return "none, the machine is on rigid ground";
  case FrameSource::reduced_file:
    return "already reduced, file " + frame.reduced_file;
  case FrameSource::matrices:
    return "given by matrices; interfaces " +
           joined(interface_words(
               [&]
               {
                 std::vector<fem::InterfaceSpecification> names;
                 for (const fem::Interface &interface : frame.matrices.interfaces)
                   names.emplace_back().name = interface.name;
                 return names;
               }())) +
           "; " + reduction_text(scene);
  case FrameSource::parts:
    return count_text(frame.parts.parts.size(), "part") + ", " + count_text(frame.parts.joints.size(), "joint") +
           "; interfaces " + joined(interface_words(coupling::interfaces_in_frame(frame.parts))) + "; " +
           reduction_text(scene);
  case FrameSource::geometry:
    return standing(frame.geometry) + "; interfaces " + joined(interface_words(frame.geometry.interfaces)) + "; " +
           reduction_text(scene);
  }
  return "";
}

std::string body_text(const BodyRequest &body)
{
  static const std::array<const char *, 5> kinds = {"rotor", "slider", "point mass", "planar body", "rigid body"};
  return "'" + body.name + "' (" + kinds[std::size_t(body.kind)] +
         (body.carrier.empty() ? ""
                               : (body.kind == coupling::BodyKind::slider ? " guided by " : " on ") + body.carrier) +
         ")";
}

std::string joint_text(const JointRequest &joint)
{
  const std::string type = joint.is_scalar() ? "measure" : joint.type;
  const std::string kind = joint.law != nullptr ? "driven " + type : type;
  return "'" + joint.name + "' (" + kind + (joint.compliance ? ", compliant" : "") + ")";
}

/// Names of elements without the names of their parts, such as "guide.rear".
std::string element_names(Words names)
{
  for (std::string &name : names)
    name = "'" + name.substr(0, name.find('.')) + "'";
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return joined(names);
}

template <typename Requests>
Words names_of(const Requests &requests)
{
  Words names;
  for (const auto &request : requests)
    names.push_back(request.name);
  return names;
}

std::string laws_text(const Scene &scene)
{
  Words      parts;
  const auto add = [&](const char *what, const Words &names)
  {
    if (!names.empty())
      parts.push_back(what + (" " + element_names(names)));
  };
  add("nonlinear", names_of(scene.elements));
  add("linear", names_of(scene.linear));
  add("loads", names_of(scene.loads));
  add("masses", names_of(scene.point_masses));
  std::string text;
  for (const std::string &part : parts)
    text += (text.empty() ? "" : "; ") + part;
  return text;
}

/// Number of DOFs that joints leave to the mechanism in the reference configuration, with its frame at rest.
long n_free(coupling::Machine &machine)
{
  std::vector<int> frame(std::size_t(machine.model().n_frame()));
  std::iota(frame.begin(), frame.end(), 0);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(machine.size());
  coupling::LocalState  local;
  local.resize(machine);
  machine.gather(0., zero, zero, zero, local);
  machine.events().start(local);
  return coupling::free_motions(machine, local, frame).cols();
}

/// A frame that is not yet computed has internal DOFs in addition to those of its placeholder.
std::string coordinates_text(const Scene &scene, coupling::Machine &machine)
{
  const int         n_frame = machine.model().n_frame(), n_rows = int(machine.joints().n_rows());
  const bool        made      = scene.frame.source == FrameSource::geometry || scene.frame.source == FrameSource::parts;
  const std::string of_bodies = std::to_string(machine.size() - n_frame) + " of bodies";
  std::string       text;
  if (n_frame > 0)
    text = std::to_string(n_frame) + (made ? " of interfaces and internal modes, " : " of the frame, ");
  text += of_bodies;
  if (n_rows == 0)
    return text;
  text += "; " + count_text(std::size_t(n_rows), "equation") + " of joints and rigid bodies";
  constexpr int most_coordinates = 600; // limit for the computation of the DOFs, whose cost grows with the third power
  if (places_known(scene) && machine.size() <= most_coordinates)
    text += "; mechanism on a fixed frame: " + count_text(std::size_t(n_free(machine)), "DOF");
  return text;
}

std::string start_text(const StartRequest &start)
{
  if (start.periodic)
    return "on the periodic solution";
  switch (start.rule)
  {
  case StartRule::given:
    return "given coordinates and velocities, all others zero";
  case StartRule::rest:
    return start.drift ? "static equilibrium with the slow motion of the drives" : "static equilibrium";
  case StartRule::steady:
    return "steady rotation";
  }
  return "";
}

/// [s] of a step, from runs of the scenes that come with the program: 4 us of the press, 140 us of the crane with its
/// 57 coordinates and joints.
double step_time(int n, bool has_joints)
{
  return has_joints ? 10e-6 + 130e-6 * std::pow(n / 57., 1.5) : 3e-6 + 0.02e-6 * n;
}

std::string duration_text(double seconds)
{
  return seconds < 1.    ? "less than a second"
         : seconds < 90. ? "about " + rounded(seconds, 1) + " s"
                         : "about " + rounded(seconds / 60., 1) + " min";
}

std::string run_text(const Scene &scene, const coupling::Machine &machine)
{
  const coupling::RunOptions    &o      = scene.run.options;
  const coupling::MethodOptions &method = o.method;
  std::string                    text   = method.method + " to t = " + rounded(o.end) + " s";
  if (coupling::controlled(method))
    return text + ", step control with tolerance " + rounded(method.tolerance);
  if (method.step <= 0. || !scene.run.step_given)
    return text;
  const double steps = std::ceil((o.end - o.begin) / method.step);
  text += " in " + rounded(steps, 6) + " steps of " + rounded(method.step) + " s";
  if (!scene.reduction.reduces() && scene.frame.source == FrameSource::geometry)
    return text;            // of a whole frame: as long as its factors take
  constexpr int modes = 25; // of a frame that is not made yet
  const int     n     = machine.size() + (scene.frame.source == FrameSource::geometry ? modes : 0);
  return text + ", run time " + duration_text(steps * step_time(n, machine.joints().n_rows() > 0));
}

} // namespace

std::vector<std::string> scene_summary(const Scene &scene)
{
  coupling::Machine machine = machine_to_check(scene);
  Words             lines{"frame       " + frame_text(scene)};
  if (const std::string damping = damping_text(scene.frame); !damping.empty())
    lines.push_back("damping     " + damping);
  Words bodies, joints;
  for (const BodyRequest &body : scene.bodies)
    bodies.push_back(body_text(body));
  for (const JointRequest &joint : scene.joints)
    joints.push_back(joint_text(joint));
  if (!bodies.empty())
    lines.push_back("bodies      " + joined(bodies));
  if (!joints.empty())
    lines.push_back("joints      " + joined(joints));
  if (const std::string laws = laws_text(scene); !laws.empty())
    lines.push_back("elements    " + laws);
  lines.push_back("DOFs        " + coordinates_text(scene, machine));
  if (scene.run.given)
  {
    lines.push_back("initial     " + start_text(scene.start));
    lines.push_back("run         " + run_text(scene, machine));
  }
  if (!scene.signals.empty())
    lines.push_back("signals     " + joined(names_of(scene.signals)));
  return lines;
}

} // namespace gestell::apps
