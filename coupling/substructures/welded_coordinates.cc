#include "coupling/substructures/welded_coordinates.h"

#include "coupling/substructures/require_joints.h"
#include "coupling/substructures/rigid_node.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double usual_tolerance = 1e-3; ///< of the size of the larger part

bool is_welded(const FrameJoint &joint)
{
  return joint.kind == JointKind::weld || joint.kind == JointKind::contact;
}

/// Diagonal of the box about its points and interfaces [m].
double size_of(const ReducedFrame &part)
{
  Eigen::AlignedBox3d box;
  for (const auto &point : part.points)
    box.extend(Vector3d(point[0], point[1], point[2]));
  for (const fem::Interface &interface : part.interfaces)
    box.extend(position_of(interface));
  return box.isEmpty() ? 0. : box.diagonal().norm();
}

double tolerance_of(const FrameJoint &joint, const FrameOfParts &frame, const std::vector<ReducedFrame> &of)
{
  if (joint.tolerance)
    return *joint.tolerance;
  double size = 0.;
  for (const JointEnd &end : joint.between)
    size = std::max(size, size_of(of[std::size_t(frame.find(end.part) - frame.parts.data())]));
  return usual_tolerance * size;
}

} // namespace

WeldedCoordinates weld(const FrameOfParts &frame, const PartUnion &parts, const std::vector<ReducedFrame> &of)
{
  WeldedCoordinates welded;
  welded.kept.assign(std::size_t(parts.size()), 0);
  for (const FrameJoint &joint : frame.joints)
  {
    if (joint.kind != JointKind::tie_rod)
      require_meeting(joint, position_of(parts.at(joint.between[0])), position_of(parts.at(joint.between[1])),
                      tolerance_of(joint, frame, of));
    if (is_welded(joint))
      for (const int i : parts.at(joint.between[1]).coordinate)
        welded.kept[std::size_t(i)] = -1;
  }
  int n_joined = 0;
  for (int &column : welded.kept)
    column = column < 0 ? -1 : n_joined++;
  welded.G = MatrixXd::Zero(parts.size(), n_joined);
  for (Index i = 0; i < parts.size(); ++i)
    if (const int column = welded.kept[std::size_t(i)]; column >= 0)
      welded.G(i, column) = 1.;
  for (const FrameJoint &joint : frame.joints)
    if (is_welded(joint))
    {
      const fem::Interface &first = parts.at(joint.between[0]), &second = parts.at(joint.between[1]);
      welded.G += motions_of(second, parts.size()).transpose() * carried(position_of(first), position_of(second)) *
                  motions_of(first, parts.size()) * welded.G;
    }
  return welded;
}

} // namespace gestell::coupling
