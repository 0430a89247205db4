#include "coupling/substructures/frame_of_parts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace gestell::coupling
{

double TieRod::area() const
{
  return M_PI / 4. * diameter * diameter;
}

double TieRod::stiffness(double length) const
{
  return E * area() / length;
}

const FramePart *FrameOfParts::find(const std::string &part) const
{
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const FramePart &own) { return own.name == part; });
  return found == parts.end() ? nullptr : &*found;
}

std::vector<std::string> kept_interfaces(const FrameOfParts &frame)
{
  std::set<std::string> joined;
  for (const FrameJoint &joint : frame.joints)
    for (const JointEnd &end : joint.between)
      joined.insert(end.name());
  for (const FrameJoint &joint : frame.joints)
    if (joint.keep)
      joined.erase(joint.between[0].name());
  std::vector<std::string> kept;
  for (const FramePart &part : frame.parts)
    for (const fem::InterfaceSpecification &interface : part.geometry.interfaces)
      if (const std::string name = JointEnd{part.name, interface.name}.name(); !joined.count(name))
        kept.push_back(name);
  return kept;
}

std::vector<fem::InterfaceSpecification> interfaces_in_frame(const FrameOfParts &frame)
{
  const auto                               names = kept_interfaces(frame);
  std::vector<fem::InterfaceSpecification> interfaces;
  for (const FramePart &part : frame.parts)
    for (fem::InterfaceSpecification interface : part.geometry.interfaces)
    {
      interface.name = JointEnd{part.name, interface.name}.name();
      if (std::find(names.begin(), names.end(), interface.name) == names.end())
        continue;
      if (interface.position)
      {
        const Eigen::Vector3d x =
            part.placement.at + part.placement.Q * Eigen::Map<const Eigen::Vector3d>(interface.position->data());
        interface.position = fem::Vector3{x[0], x[1], x[2]};
      }
      interfaces.push_back(std::move(interface));
    }
  return interfaces;
}

std::vector<std::pair<std::string, std::string>> joint_outputs(const FrameJoint &joint)
{
  const std::string head = "joint." + joint.name + ".";
  if (joint.kind == JointKind::tie_rod)
    return {{head + "force", "N"}};
  std::vector<std::pair<std::string, std::string>> outputs;
  for (const char *force : {"fx", "fy", "fz"})
    outputs.emplace_back(head + force, "N");
  for (const char *moment : {"mx", "my", "mz"})
    outputs.emplace_back(head + moment, "N m");
  if (joint.closes())
    outputs.emplace_back(head + "normal_force", "N");
  return outputs;
}

} // namespace gestell::coupling
