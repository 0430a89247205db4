#include "coupling/substructures/require_joints.h"

#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

[[noreturn]] void refuse(const std::string &place, const std::string &what)
{
  throw std::invalid_argument(place + ": " + what);
}

std::vector<std::string> names_of(const std::vector<FramePart> &parts)
{
  std::vector<std::string> names;
  for (const FramePart &part : parts)
    names.push_back(part.name);
  return names;
}

std::vector<std::string> interfaces_of(const FramePart &part)
{
  std::vector<std::string> names;
  for (const fem::InterfaceSpecification &interface : part.geometry.interfaces)
    names.push_back(interface.name);
  return names;
}

void require_end(const FrameOfParts &frame, const FrameJoint &joint, const JointEnd &end)
{
  const FramePart *part = frame.find(end.part);
  if (!part)
    refuse(joint.place, "there is no part '" + end.part + "'" + suggestion(end.part, names_of(frame.parts)));
  const auto &interfaces = part->geometry.interfaces;
  const auto  interface =
      std::find_if(interfaces.begin(), interfaces.end(), [&](const auto &own) { return own.name == end.interface; });
  if (interface == interfaces.end())
    refuse(joint.place, "part '" + end.part + "' has no interface '" + end.interface + "'" +
                            suggestion(end.interface, interfaces_of(*part)));
  if (interface->coupling == fem::InterfaceCoupling::node)
    refuse(joint.place, "interface '" + end.name() +
                            "' is a node of the mesh, which has no rotations to join; set coupling = "
                            "\"rigid\" or \"average\"");
}

const fem::InterfaceSpecification &interface_of(const FrameOfParts &frame, const JointEnd &end)
{
  const auto &interfaces = frame.find(end.part)->geometry.interfaces;
  return *std::find_if(interfaces.begin(), interfaces.end(),
                       [&](const auto &own) { return own.name == end.interface; });
}

bool is_flexible(const fem::InterfaceSpecification &interface)
{
  return interface.coupling == fem::InterfaceCoupling::flexible;
}

std::string coupling_text(const fem::InterfaceSpecification &interface)
{
  return is_flexible(interface) ? "flexible of degree " + std::to_string(interface.degree) : "not flexible";
}

/// Flexible faces move alike: both sides of a weld or contact have fields of one degree.
void require_alike(const FrameOfParts &frame, const FrameJoint &joint)
{
  const auto &first = interface_of(frame, joint.between[0]), &second = interface_of(frame, joint.between[1]);
  if (!is_flexible(first) && !is_flexible(second))
    return;
  if (joint.kind == JointKind::bolts || joint.kind == JointKind::tie_rod)
    refuse(joint.place, "connects a flexible face by springs at one node; give the interface coupling = \"average\", "
                        "or make the joint a weld or a contact");
  if (first.degree != second.degree || is_flexible(first) != is_flexible(second))
    refuse(joint.place, "'" + joint.between[0].name() + "' is " + coupling_text(first) + ", '" +
                            joint.between[1].name() + "' " + coupling_text(second) +
                            "; give both coupling = \"flexible\" with the same 'degree'");
}

/// Refuses faces with fields that no joint uses: their coordinates would have no meaning.
void require_joined_faces(const FrameOfParts &frame)
{
  std::set<std::string> joined;
  for (const FrameJoint &joint : frame.joints)
    for (const JointEnd &end : joint.between)
      joined.insert(end.name());
  for (const FramePart &part : frame.parts)
    for (const fem::InterfaceSpecification &interface : part.geometry.interfaces)
      if (is_flexible(interface) && joined.count(JointEnd{part.name, interface.name}.name()) == 0)
        refuse(part.place, "interface '" + interface.name +
                               "' is flexible, but has no joint; set coupling = \"rigid\" or \"average\"");
}

/// Joints that fasten faces: an interface takes part in one of them.
void require_single_use(const FrameOfParts &frame)
{
  std::map<std::string, std::string> user;
  for (const FrameJoint &joint : frame.joints)
    if (joint.kind != JointKind::tie_rod)
      for (const JointEnd &end : joint.between)
        if (const auto [other, is_new] = user.emplace(end.name(), joint.name); !is_new)
          refuse(joint.place, "interface '" + end.name() + "' is joined by '" + other->second +
                                  "'; divide its surfaces into one interface for each joint");
}

/// Parts that joints connect with the first one.
std::set<std::string> reached(const FrameOfParts &frame)
{
  std::set<std::string> known{frame.parts.front().name};
  for (std::size_t before = 0; before != known.size();)
  {
    before = known.size();
    for (const FrameJoint &joint : frame.joints)
      if (known.count(joint.between[0].part) || known.count(joint.between[1].part))
        for (const JointEnd &end : joint.between)
          known.insert(end.part);
  }
  return known;
}

void require_connected(const FrameOfParts &frame)
{
  const auto known = reached(frame);
  for (const FramePart &part : frame.parts)
    if (!known.count(part.name))
      refuse(part.place, "no joint connects this part with '" + frame.parts.front().name +
                             "'; join it by [frame.joint.NAME] between = [\"" + part.name +
                             ".INTERFACE\", \"OTHER PART.INTERFACE\"]");
}

std::string text_of(const Eigen::Vector3d &x)
{
  const double scale = 1e-9 * std::max(1e-3, x.norm()); // less is rounding
  const auto   shown = [scale](double value) { return rounded(std::abs(value) > scale ? value : 0.); };
  return "(" + shown(x[0]) + ", " + shown(x[1]) + ", " + shown(x[2]) + ") m";
}

/// Position of an interface in the frame, if it is known.
std::optional<Eigen::Vector3d> place_of(const FrameOfParts &frame, const JointEnd &end)
{
  const FramePart &part = *frame.find(end.part);
  for (const fem::InterfaceSpecification &interface : part.geometry.interfaces)
    if (interface.name == end.interface && interface.position)
      return part.placement.at + part.placement.Q * Eigen::Map<const Eigen::Vector3d>(interface.position->data());
  return {};
}

} // namespace

void require_meeting(const FrameJoint &joint, const Eigen::Vector3d &first, const Eigen::Vector3d &second,
                     double tolerance)
{
  const double distance = (second - first).norm();
  if (distance > tolerance)
    refuse(joint.place, "the interfaces do not meet: '" + joint.between[0].name() + "' is at " + text_of(first) +
                            ", '" + joint.between[1].name() + "' at " + text_of(second) + ", " +
                            rounded(1e3 * distance) + " mm apart, but the tolerance is " + rounded(1e3 * tolerance) +
                            " mm; move a part by its 'placement', give the interfaces the same 'position', or allow "
                            "the distance by tolerance = \"" +
                            rounded(1.1e3 * distance) + " mm\"");
}

void require_meeting(const FrameOfParts &frame, const std::vector<double> &diagonals)
{
  for (const FrameJoint &joint : frame.joints)
    if (joint.kind != JointKind::tie_rod)
      if (const auto first = place_of(frame, joint.between[0]), second = place_of(frame, joint.between[1]);
          first && second)
        if (const double tolerance = tolerance_of(joint, frame, diagonals); tolerance > 0.)
          require_meeting(joint, *first, *second, tolerance);
}

double tolerance_of(const FrameJoint &joint, const FrameOfParts &frame, const std::vector<double> &diagonals)
{
  constexpr double usual = 1e-3; // of the size of the larger part
  double           size  = 0.;
  for (const JointEnd &end : joint.between)
    size = std::max(size, diagonals[std::size_t(frame.find(end.part) - frame.parts.data())]);
  return joint.tolerance.value_or(usual * size);
}

void require_joints(const FrameOfParts &frame)
{
  for (const FrameJoint &joint : frame.joints)
  {
    for (const JointEnd &end : joint.between)
      require_end(frame, joint, end);
    if (joint.between[0].part == joint.between[1].part)
      refuse(joint.place, joint.kind == JointKind::tie_rod
                              ? "both ends of the tie rod are on part '" + joint.between[0].part +
                                    "'; a rod within a part is an [element.NAME] type = \"spring-damper\" between its "
                                    "interfaces"
                              : "joins part '" + joint.between[0].part +
                                    "' with itself; name an interface of another "
                                    "part");
    require_alike(frame, joint);
  }
  require_joined_faces(frame);
  require_single_use(frame);
  require_connected(frame);
}

} // namespace gestell::coupling
