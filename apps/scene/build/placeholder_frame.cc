#include "apps/scene/build/placeholder_frame.h"

#include "fem/values/stress_recovery.h"
#include "fem/values/two_pi.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <sstream>
#include <utility>

namespace gestell::apps
{
namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr double one_direction = 1e-9; ///< directions that differ by less are one

using NameAndUnit = std::pair<std::string, std::string>;

coupling::ReducedFrame without_physics(std::vector<fem::Interface> interfaces, const std::vector<NameAndUnit> &outputs)
{
  coupling::ReducedFrame frame;
  int                    n = 0;
  for (auto &interface : interfaces)
    for (int &coordinate : interface.coordinate)
      coordinate = coordinate < 0 ? -1 : n++;
  frame.M = frame.C       = MatrixXd::Identity(n, n);
  frame.B                 = MatrixXd::Zero(n, n);
  frame.n_interface       = n;
  frame.translations_load = MatrixXd::Zero(n, 3);
  frame.interfaces        = std::move(interfaces);
  for (const auto &[name, unit] : outputs)
    frame.outputs.push_back({name, unit, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)});
  return frame;
}

std::vector<fem::Interface> six_motions_of(const std::vector<fem::InterfaceSpecification> &specified)
{
  std::vector<fem::Interface> interfaces;
  for (const auto &interface : specified)
  {
    interfaces.push_back(
        {interface.name, interface.position.value_or(fem::Vector3{}), {0, 1, 2, 3, 4, 5}, {1., 1., 1., 1., 1., 1.}});
    if (interface.coupling == fem::InterfaceCoupling::node)
      for (int rotation = fem::rx; rotation <= fem::rz; ++rotation)
        interfaces.back().coordinate[rotation] = -1;
  }
  return interfaces;
}

std::vector<NameAndUnit> outputs_of(const fem::FrameSpecification &specification)
{
  std::vector<NameAndUnit> outputs;
  for (const auto &cut : specification.cuts)
    for (const auto &[ending, unit] : fem::section_components)
      outputs.emplace_back("cut." + cut.name + ending, unit);
  for (const auto &support : specification.supports)
    for (const std::string direction : {"x", "y", "z"})
      outputs.emplace_back("support." + support.name + "." + direction, "N");
  for (const auto &point : specification.stress_points)
  {
    for (const char *component : fem::stress_names)
      outputs.emplace_back("stress." + point.name + "." + component, "Pa");
    if (point.along)
      outputs.emplace_back("stress." + point.name + ".normal", "Pa");
  }
  return outputs;
}

coupling::ReducedFrame stand_in_for(const fem::FrameSpecification &specification)
{
  return without_physics(six_motions_of(specification.interfaces), outputs_of(specification));
}

coupling::ReducedFrame stand_in_for(const coupling::FrameOfParts &frame)
{
  std::vector<NameAndUnit> outputs;
  for (const coupling::FramePart &part : frame.parts)
    for (const auto &[name, unit] : outputs_of(part.geometry))
      outputs.emplace_back(part.name + "." + name, unit);
  for (const coupling::FrameJoint &joint : frame.joints)
    for (const NameAndUnit &output : coupling::joint_outputs(joint))
      outputs.push_back(output);
  return without_physics(six_motions_of(coupling::interfaces_in_frame(frame)), outputs);
}

/// Only the sizes of matrices that are too large for a quick examination.
coupling::ReducedFrame stand_in_for(const fem::FrameMatrices &matrices)
{
  std::vector<NameAndUnit> outputs;
  for (const auto &output : matrices.outputs)
    outputs.emplace_back(output.name, output.unit);
  return without_physics(matrices.interfaces, outputs);
}

/// Directions of space that supports resist elastically or rigidly: sum of their dyads.
Eigen::Matrix3d resisted(const std::vector<fem::Support> &supports)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const fem::Support &support : supports)
    for (int d = 0; d < 3; ++d)
    {
      const bool     clamped = support.kind == fem::SupportKind::clamped;
      const Vector3d axis = clamped ? Vector3d(Vector3d::Unit(d)) : Eigen::Map<const Vector3d>(support.axes[d].data());
      if (clamped ? support.held[d] : support.stiffness[d] > 0.)
        sum += axis.normalized() * axis.normalized().transpose();
    }
  return sum;
}

/// The same for parts with their own supports.
Eigen::Matrix3d resisted(const coupling::FrameOfParts &frame)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const coupling::FramePart &part : frame.parts)
    sum += part.placement.Q * resisted(part.geometry.supports) * part.placement.Q.transpose();
  return sum;
}

/// Whether a frame from geometry has supports.
bool has_supports(const FrameRequest &frame)
{
  return !frame.geometry.supports.empty() ||
         std::any_of(frame.parts.parts.begin(), frame.parts.parts.end(),
                     [](const coupling::FramePart &part) { return !part.geometry.supports.empty(); });
}

/// Orthonormal, the axes themselves where they are free [3 x k].
MatrixXd free_directions(const Eigen::Matrix3d &resisted)
{
  if (resisted.isDiagonal(one_direction))
  {
    MatrixXd axes(3, 0);
    for (int d = 0; d < 3; ++d)
      if (resisted(d, d) <= one_direction)
      {
        axes.conservativeResize(3, axes.cols() + 1);
        axes.rightCols(1) = Vector3d::Unit(d);
      }
    return axes;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(resisted);
  return eigen.eigenvectors().leftCols((eigen.eigenvalues().array() <= one_direction).count());
}

MatrixXd free_directions(const Scene &scene)
{
  if (scene.frame.source == FrameSource::geometry)
    return free_directions(resisted(scene.frame.geometry.supports));
  if (scene.frame.source == FrameSource::parts)
    return free_directions(resisted(scene.frame.parts));
  Eigen::Matrix3d           held  = Eigen::Matrix3d::Zero();
  const fem::FrameMatrices &frame = scene.frame.matrices;
  for (int d = 0; d < 3; ++d)
  {
    const Eigen::VectorXd t       = frame.translations.col(d);
    const double          cancels = t.cwiseAbs().dot(frame.C.cwiseAbs() * t.cwiseAbs());
    // Relative to the energies that cancel in a rigid-body mode, as in fem::free_motions().
    constexpr double free_share = 1e-13;
    held(d, d)                  = t.isZero() || t.dot(frame.C * t) > free_share * cancels;
  }
  return free_directions(held);
}

std::string name_of(const Vector3d &direction)
{
  const Eigen::IOFormat triple(3, 0, ", ", ", ", "", "", "(", ")");
  std::ostringstream    text;
  Eigen::Index          d;
  if (direction.cwiseAbs().maxCoeff(&d) > 1. - one_direction)
    text << "translation along "
         << "xyz"[d];
  else
    text << "translation along " << direction.format(triple);
  return text.str();
}

std::vector<std::string> names_of(const MatrixXd &directions, bool turns)
{
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < directions.cols(); ++k)
    names.push_back(name_of(directions.col(k)));
  for (const char axis : turns ? std::string("xyz") : "")
    names.push_back(std::string("rotation about ") + axis);
  return names;
}

Vector3d middle_of(const std::vector<fem::Interface> &interfaces)
{
  Vector3d sum = Vector3d::Zero();
  for (const fem::Interface &interface : interfaces)
    sum += Eigen::Map<const Vector3d>(interface.position.data());
  return sum / std::max<std::size_t>(1, interfaces.size());
}

/// Motions of the interfaces with a rigid body [n x 6]: translations along, rotations about x, y, z.
MatrixXd rigid_motions(const coupling::ReducedFrame &frame)
{
  const Vector3d middle = middle_of(frame.interfaces);
  MatrixXd       R      = MatrixXd::Zero(frame.n_interface, 6);
  for (const fem::Interface &interface : frame.interfaces)
    for (int d = 0; d < 3; ++d)
    {
      const Vector3d lever = Eigen::Map<const Vector3d>(interface.position.data()) - middle;
      if (const int u = interface.coordinate[d]; u >= 0)
      {
        R(u, d) = 1.;
        for (int axis = 0; axis < 3; ++axis)
          R(u, 3 + axis) = Vector3d::Unit(axis).cross(lever)[d];
      }
      if (const int r = interface.coordinate[3 + d]; r >= 0)
        R(r, 3 + d) = 1.;
    }
  return R;
}

} // namespace

coupling::ReducedFrame placeholder_frame(const Scene &scene)
{
  return scene.frame.source == FrameSource::geometry ? stand_in_for(scene.frame.geometry)
         : scene.frame.source == FrameSource::parts  ? stand_in_for(scene.frame.parts)
                                                     : stand_in_for(scene.frame.matrices);
}

coupling::ReducedFrame rigid_stand_in(const Scene &scene)
{
  coupling::ReducedFrame frame = placeholder_frame(scene);
  const MatrixXd         D = free_directions(scene), R = rigid_motions(frame);
  const bool             turns = scene.frame.source != FrameSource::matrices && !has_supports(scene.frame);
  frame.facts.free_motions     = names_of(D, turns);
  frame.translations_load      = frame.M * R.leftCols(3);

  MatrixXd Q(R.rows(), 0);
  if (!frame.facts.free_motions.empty())
  {
    MatrixXd free(R.rows(), D.cols() + (turns ? 3 : 0));
    free << R.leftCols(3) * D, R.rightCols(turns ? 3 : 0);
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(free);
    Q = qr.householderQ() * MatrixXd::Identity(R.rows(), qr.rank());
  }
  constexpr double elastic_hz = 1000.; // far above the frequencies of elements with the masses of a machine
  const double     omega      = two_pi * elastic_hz;
  frame.C                     = omega * omega * (frame.M - Q * Q.transpose());
  frame.frequencies_hz        = Eigen::VectorXd::Constant(R.rows(), elastic_hz);
  frame.frequencies_hz.head(Q.cols()).setZero();
  return frame;
}

} // namespace gestell::apps
