#include "coupling/substructures/joint_springs.h"

#include "coupling/substructures/rigid_node.h"

#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A diag(k) A^T.
Eigen::Matrix3d along(const Eigen::Matrix3d &axes, const Vector3d &k)
{
  return axes * k.asDiagonal() * axes.transpose();
}

/// 6 x 6 at a point, of springs k at bolts and k_r against turning.
Matrix6 of_bolts(const BoltedJoint &bolts, const Vector3d &point, const Vector3d &k, const Vector3d &k_r)
{
  Matrix6 K                    = Matrix6::Zero();
  K.bottomRightCorner<3, 3>()  = along(bolts.axes, k_r);
  std::vector<Vector3d> places = bolts.positions;
  if (places.empty())
    places.push_back(point);
  for (const Vector3d &bolt : places)
  {
    const Eigen::Matrix<double, 3, 6> H = carried(point, bolt).topRows<3>();
    K += H.transpose() * along(bolts.axes, k) * H;
  }
  return K;
}

JointSpring bolted(const FrameJoint &joint, const PartUnion &parts)
{
  const fem::Interface &first = parts.at(joint.between[0]), &second = parts.at(joint.between[1]);
  const Vector3d        point = 0.5 * (position_of(first) + position_of(second));
  const auto            n     = parts.size();
  return {carried(position_of(second), point) * motions_of(second, n) -
              carried(position_of(first), point) * motions_of(first, n),
          of_bolts(joint.bolts, point, joint.bolts.stiffness, joint.bolts.rotational),
          of_bolts(joint.bolts, point, joint.bolts.damping, joint.bolts.rotational_damping)};
}

/// Vector from the first end to the second [m].
Vector3d span(const FrameJoint &joint, const PartUnion &parts)
{
  return position_of(parts.at(joint.between[1])) - position_of(parts.at(joint.between[0]));
}

} // namespace

Eigen::VectorXd elongation(const FrameJoint &joint, const PartUnion &parts)
{
  const Vector3d d = span(joint, parts);
  if (d.norm() == 0.)
    throw std::invalid_argument(joint.place + ": both ends of the tie rod are at the same point, so it has no "
                                              "direction; give its interfaces the 'position' of the anchor points");
  const auto n = parts.size();
  return (motions_of(parts.at(joint.between[1]), n) - motions_of(parts.at(joint.between[0]), n))
             .topRows<3>()
             .transpose() *
         d.normalized();
}

Eigen::MatrixXd transverse_stiffness(const FrameJoint &joint, const PartUnion &parts)
{
  const auto     n = parts.size();
  const MatrixXd R = (motions_of(parts.at(joint.between[1]), n) - motions_of(parts.at(joint.between[0]), n)).topRows(3);
  const Vector3d d = span(joint, parts).normalized();
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - d * d.transpose();
  return joint.rod.tension / span(joint, parts).norm() * R.transpose() * P * R;
}

double length_of(const FrameJoint &joint, const PartUnion &parts)
{
  return joint.rod.length.value_or(span(joint, parts).norm());
}

double mass_of_rod(const FrameJoint &joint, const PartUnion &parts)
{
  return joint.rod.rho * joint.rod.area() * length_of(joint, parts);
}

JointSpring spring_of(const FrameJoint &joint, const PartUnion &parts)
{
  if (joint.kind != JointKind::tie_rod)
    return bolted(joint, parts);
  const MatrixXd R = elongation(joint, parts).transpose();
  return {R, MatrixXd::Constant(1, 1, joint.rod.stiffness(length_of(joint, parts))),
          MatrixXd::Constant(1, 1, joint.rod.damping)};
}

} // namespace gestell::coupling
