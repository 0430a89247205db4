#include "coupling/substructures/placed_part.h"

#include "coupling/substructures/stress_of_parts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

std::array<double, 3> as_array(const Vector3d &x)
{
  return {x[0], x[1], x[2]};
}

Vector3d moved(const std::array<double, 3> &x, const Placement &placement)
{
  return placement.at + placement.Q * Eigen::Map<const Vector3d>(x.data());
}

bool is_whole(const fem::Interface &interface, int first)
{
  return std::all_of(&interface.coordinate[first], &interface.coordinate[first] + 3, [](int i) { return i >= 0; });
}

bool is_absent(const fem::Interface &interface, int first)
{
  return std::all_of(&interface.coordinate[first], &interface.coordinate[first] + 3, [](int i) { return i < 0; });
}

/// Rotates three rows of an interface: motion_part = turn motion.
void turn_three(MatrixXd &S, const fem::Interface &interface, int first, const Matrix3d &turn)
{
  if (is_absent(interface, first))
    return;
  if (!is_whole(interface, first) && !turn.isIdentity(0.))
    throw std::invalid_argument("interface '" + interface.name +
                                "' is supported in some directions, so its part cannot be rotated or mirrored");
  for (int i = 0; i < 3; ++i)
    if (const int row = interface.coordinate[first + i]; row >= 0)
    {
      S(row, row) = 0.;
      for (int j = 0; j < 3; ++j)
        if (const int column = interface.coordinate[first + j]; column >= 0)
          S(row, column) = interface.sign[first + i] * turn(i, j);
    }
}

} // namespace

MatrixXd turned_coordinates(const ReducedFrame &part, const Matrix3d &Q)
{
  MatrixXd S = MatrixXd::Identity(part.M.rows(), part.M.rows());
  for (const fem::Interface &interface : part.interfaces)
  {
    turn_three(S, interface, fem::ux, Q.transpose());
    turn_three(S, interface, fem::rx, Q.determinant() * Q.transpose());
  }
  return S;
}

namespace
{

void turn_picture(ReducedFrame &part, const Placement &placement, const MatrixXd &S)
{
  for (auto &point : part.points)
    point = as_array(moved(point, placement));
  if (placement.Q.determinant() < 0.)
    for (auto &triangle : part.triangles)
      std::swap(triangle[1], triangle[2]);
  const Eigen::Matrix3f Q = placement.Q.cast<float>();
  for (Eigen::Index i = 0; 3 * i < part.displacement.rows(); ++i)
    part.displacement.middleRows<3>(3 * i) = (Q * part.displacement.middleRows<3>(3 * i)).eval();
  part.displacement = part.displacement * S.cast<float>();
}

void turn_outputs(ReducedFrame &part, const Matrix3d &Q, const MatrixXd &S)
{
  for (fem::FrameOutput &output : part.outputs)
  {
    for (Eigen::VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      if (row->size() > 0)
        *row = (S.transpose() * *row).eval();
    output.under_acceleration = (Q * output.under_acceleration).eval();
  }
}

void turn_mass(fem::MassProperties &body, const Placement &placement)
{
  body.centre  = placement.at + placement.Q * body.centre;
  body.inertia = (placement.Q * body.inertia * placement.Q.transpose()).eval();
}

void turn(ReducedFrame &part, const Placement &placement)
{
  const MatrixXd S = turned_coordinates(part, placement.Q);
  part.M           = S.transpose() * (part.M * S).eval();
  part.B           = S.transpose() * (part.B * S).eval();
  part.C           = S.transpose() * (part.C * S).eval();
  if (part.left_out.size() > 0)
  {
    const MatrixXd S_1 = S.topLeftCorner(part.n_interface, part.n_interface);
    part.left_out      = S_1.transpose() * (part.left_out * S_1).eval();
  }
  part.translations_load = S.transpose() * (part.translations_load * placement.Q.transpose()).eval();
  turn_outputs(part, placement.Q, S);
  turn_picture(part, placement, S);
  turn_stress(part.stress, placement.Q, S);
  turn_mass(part.facts.whole, placement);
  for (fem::Interface &interface : part.interfaces)
  {
    interface.position    = as_array(moved(interface.position, placement));
    interface.face.centre = placement.at + placement.Q * interface.face.centre;
    interface.face.axes   = (placement.Q * interface.face.axes).eval();
    interface.sign.fill(1.);
  }
}

} // namespace

ReducedFrame placed(ReducedFrame part, const std::string &name, const Placement &placement)
{
  turn(part, placement);
  for (fem::Interface &interface : part.interfaces)
    interface.name = JointEnd{name, interface.name}.name();
  for (fem::FrameOutput &output : part.outputs)
    output.name = name + "." + output.name;
  for (auto &solid : part.facts.parts)
    solid.name = solid.name.empty() ? name : name + ": " + solid.name;
  return part;
}

std::vector<ReducedFrame> all_placed(std::vector<ReducedFrame> parts, const FrameOfParts &frame)
{
  for (std::size_t i = 0; i < parts.size(); ++i)
    try
    {
      parts[i] = placed(std::move(parts[i]), frame.parts[i].name, frame.parts[i].placement);
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(frame.parts[i].place + ": " + error.what());
    }
  return parts;
}

} // namespace gestell::coupling
