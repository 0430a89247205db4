#pragma once

#include "fem/values/frame_specification.h"
#include "fem/values/modal_ratios.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Placement of a part:  x = at + Q x_part,  Q orthogonal; det Q = -1 for a mirror image.
struct Placement
{
  Eigen::Matrix3d Q  = Eigen::Matrix3d::Identity();
  Eigen::Vector3d at = Eigen::Vector3d::Zero(); ///< [m]
};

/// A part of a frame as drawn, and its placement.
struct FramePart
{
  std::string             name;
  fem::FrameSpecification geometry; ///< in the part's own coordinates
  Placement               placement;
  std::string             place; ///< "press.toml:12: frame.part.crown", prefix of messages
};

enum class JointKind
{
  weld,    ///< the two interfaces move as one
  contact, ///< the same while in compression
  bolts,   ///< springs and dampers
  tie_rod  ///< a tension bar between two interfaces
};

/// Springs and dampers along orthonormal axes at each of several points, and springs for rotation.
struct BoltedJoint
{
  Eigen::Matrix3d              axes               = Eigen::Matrix3d::Identity(); ///< columns
  Eigen::Vector3d              stiffness          = Eigen::Vector3d::Zero();     ///< [N/m] of each bolt
  Eigen::Vector3d              damping            = Eigen::Vector3d::Zero();     ///< [N s/m] of each bolt
  Eigen::Vector3d              rotational         = Eigen::Vector3d::Zero();     ///< [N m/rad] of the joint
  Eigen::Vector3d              rotational_damping = Eigen::Vector3d::Zero();     ///< [N m s/rad]
  std::vector<Eigen::Vector3d> positions; ///< [m] of bolts, in the frame; none: one, midway between the two interfaces
  double                       preload = 0.; ///< [N] of all together
};

/// A bar with mass at its ends, tightened to a force.
struct TieRod
{
  double                diameter = 0., E = 0., rho = 0.; ///< [m], [Pa], [kg/m^3]
  std::optional<double> length;                          ///< [m]; none: distance of the interfaces
  double                damping = 0., prestress = 0.;    ///< [N s/m], [N] in the tightened frame at rest
  std::string           material{};                      ///< "steel", for people
  double                tension = 0.; ///< [N] whose geometric stiffness T / L resists motion across the rod

  double area() const;
  double stiffness(double length) const; ///< E A / L [N/m]
};

/// "crown.left foot": an interface of a part.
struct JointEnd
{
  std::string part, interface;

  std::string name() const { return part + "." + interface; }
};

struct FrameJoint
{
  std::string             name;
  JointKind               kind = JointKind::weld;
  std::array<JointEnd, 2> between;
  /// From the first part to the second, normal to their faces; zero: unknown.  The joint is closed under compression.
  Eigen::Vector3d       normal = Eigen::Vector3d::Zero();
  BoltedJoint           bolts;
  TieRod                rod;
  std::optional<double> tolerance;    ///< [m] distance of the interfaces' nodes; none: from the size of the parts
  bool                  keep = false; ///< the first interface also carries a part of the mechanism
  std::string           place;

  /// Whether the joint can open, which a linear frame cannot model.
  bool closes() const
  {
    return kind == JointKind::contact || (kind == JointKind::bolts && normal != Eigen::Vector3d::Zero());
  }
};

/// A frame of parts connected by joints.
struct FrameOfParts
{
  std::vector<FramePart>        parts;
  std::vector<FrameJoint>       joints;
  fem::ModalRatios              modal_damping_ratio; ///< zeta of modes of the joined frame, added to that of the parts
  std::optional<fem::Prestress> prestress;           ///< weight, tie rods
  bool                          all_modes = false;   ///< retain all modes of the parts; else by the tolerance
  std::string                   place;

  const FramePart *find(const std::string &part) const; ///< null if there is none
};

/// Interfaces of the joined frame, "crown.bearing": those without a joint, and the first ones of joints that keep them.
std::vector<std::string> kept_interfaces(const FrameOfParts &frame);

/// The same with their names in the frame.
std::vector<fem::InterfaceSpecification> interfaces_in_frame(const FrameOfParts &frame);

/// Forces of a joint available in a scene, and their units: "joint.left foot.fx" ..., "joint.rod.force".
std::vector<std::pair<std::string, std::string>> joint_outputs(const FrameJoint &joint);

} // namespace gestell::coupling
