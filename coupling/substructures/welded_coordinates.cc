#include "coupling/substructures/welded_coordinates.h"

#include "coupling/substructures/require_joints.h"
#include "coupling/substructures/rigid_node.h"
#include "fem/values/number_text.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

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

std::vector<double> sizes_of(const std::vector<ReducedFrame> &parts)
{
  std::vector<double> sizes;
  for (const ReducedFrame &part : parts)
    sizes.push_back(size_of(part));
  return sizes;
}

/// Displacement of the face at x by (u_0, theta, a) of its interface [3 x 6 + n_fields].
MatrixXd displacement_at(const fem::Interface &interface, const Vector3d &x)
{
  MatrixXd H(3, 6 + interface.face.coordinate.size());
  H.leftCols<6>()           = carried(position_of(interface), x).topRows<3>();
  H.rightCols(H.cols() - 6) = fields_at(interface.face, x);
  return H;
}

/// Points of the rectangle around a face that determine polynomials of its degree.
std::vector<Vector3d> samples_of(const fem::PlaneFace &face)
{
  std::vector<Vector3d> points;
  const int             n = face.degree + 1;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      points.push_back(face.centre + (2. * i / n - 1.) * face.half[0] * face.axes.col(0) +
                       (2. * j / n - 1.) * face.half[1] * face.axes.col(1));
  return points;
}

/// (u_0, theta, a) of the second face that moves as the first one does: T of polynomials of one degree in one plane.
MatrixXd following(const FrameJoint &joint, const fem::Interface &first, const fem::Interface &second)
{
  if (first.face.degree == 0)
    return carried(position_of(first), position_of(second));
  if (!first.face.overlaps(second.face))
    throw std::invalid_argument(joint.place + ": the flexible faces '" + first.name + "' and '" + second.name +
                                "' do not overlap; choose faces that touch, or join them by coupling = \"rigid\"");
  constexpr double parallel = 0.9998; // cosine of a degree
  if (std::abs(first.face.axes.col(2).dot(second.face.axes.col(2))) < parallel)
    throw std::invalid_argument(joint.place + ": the flexible faces '" + first.name + "' and '" + second.name +
                                "' are not in parallel planes; rotate a part by its 'placement', or join them by "
                                "coupling = \"rigid\"");
  const auto points = samples_of(first.face);
  const auto rows   = Index(3 * points.size());
  MatrixXd   one(rows, 6 + first.face.coordinate.size()), other = one;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    one.middleRows<3>(Index(3 * k))   = displacement_at(first, points[k]);
    other.middleRows<3>(Index(3 * k)) = displacement_at(second, points[k]);
  }
  return other.colPivHouseholderQr().solve(one);
}

/// Requires a normal of the joint that agrees with its faces, if these are plane.
void require_facing(const FrameJoint &joint, const fem::Interface &first, const fem::Interface &second)
{
  if (!joint.closes())
    return;
  constexpr double along_the_face = 0.5; // cosine of 60 degrees: nearer to the face than to its normal
  for (const fem::Interface *side : {&first, &second})
    if (const double cosine = std::abs(joint.normal.dot(side->face.axes.col(2)));
        side->face.known() && cosine < along_the_face)
      throw std::invalid_argument(joint.place + ": 'normal' must be normal to the faces, but is " +
                                  rounded(std::acos(cosine) * 180. / M_PI) + " degrees off the normal of '" +
                                  side->name + "'");
}

} // namespace

WeldedCoordinates weld(const FrameOfParts &frame, const PartUnion &parts, const std::vector<ReducedFrame> &of)
{
  const std::vector<double> sizes = sizes_of(of);
  WeldedCoordinates         welded;
  welded.kept.assign(std::size_t(parts.size()), 0);
  for (const FrameJoint &joint : frame.joints)
  {
    if (joint.kind != JointKind::tie_rod)
      require_meeting(joint, position_of(parts.at(joint.between[0])), position_of(parts.at(joint.between[1])),
                      tolerance_of(joint, frame, sizes));
    if (is_welded(joint))
      for (const int i : parts.at(joint.between[1]).coordinates())
        welded.kept[std::size_t(i)] = -1;
    if (joint.kind != JointKind::tie_rod)
      require_facing(joint, parts.at(joint.between[0]), parts.at(joint.between[1]));
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
      welded.G += all_motions_of(second, parts.size()).transpose() * following(joint, first, second) *
                  all_motions_of(first, parts.size()) * welded.G;
    }
  return welded;
}

MatrixXd stayed(const MatrixXd &rows, const WeldedCoordinates &welded)
{
  MatrixXd kept_rows(welded.G.cols(), rows.cols());
  for (std::size_t i = 0; i < welded.kept.size(); ++i)
    if (welded.kept[i] >= 0)
      kept_rows.row(welded.kept[i]) = rows.row(Index(i));
  return kept_rows;
}

} // namespace gestell::coupling
