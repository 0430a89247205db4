#include "coupling/dense_frame.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Coordinates of the frame: those of interfaces, ascending, then the others.
std::vector<int> interface_first(const fem::FrameMatrices &frame)
{
  std::vector<int>  order = frame.interface_coordinates();
  std::vector<bool> taken(frame.M.rows(), false);
  for (const int i : order)
    taken[i] = true;
  for (int i = 0; i < frame.M.rows(); ++i)
    if (!taken[i])
      order.push_back(i);
  return order;
}

/// The interfaces where coordinate order[i] is now called i.
std::vector<fem::Interface> renumbered(std::vector<fem::Interface> interfaces, const std::vector<int> &order)
{
  std::vector<int> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    new_index[order[i]] = int(i);
  for (auto &interface : interfaces)
    for (int &coordinate : interface.coordinate)
      coordinate = coordinate < 0 ? -1 : new_index[coordinate];
  return interfaces;
}

/// Frequencies, and what the damping ratio adds to B.
void add_modes(ReducedFrame &dense, double zeta)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(dense.C, dense.M);
  if (modes.eigenvalues().minCoeff() < -1e-9 * std::abs(modes.eigenvalues().maxCoeff()))
    throw std::invalid_argument("stiffness: has a negative eigenvalue; a frame at rest cannot push itself away");
  const VectorXd omega = modes.eigenvalues().cwiseMax(0.).cwiseSqrt();
  const MatrixXd Z     = dense.M * modes.eigenvectors();
  dense.B += Z * (2. * zeta * omega).asDiagonal() * Z.transpose();
  dense.frequencies_hz  = omega / (2. * M_PI);
  dense.frequency_error = VectorXd::Zero(omega.size());
}

} // namespace

ReducedFrame dense_frame(const fem::FrameMatrices &frame)
{
  const auto     order = interface_first(frame);
  const MatrixXd M = frame.M, B = frame.B, C = frame.C;
  ReducedFrame   dense;
  dense.M           = M(order, order);
  dense.B           = B(order, order);
  dense.C           = C(order, order);
  dense.n_interface = int(frame.interface_coordinates().size());
  dense.modal       = false;
  dense.n_full      = int(M.rows());
  dense.mass        = frame.mass;
  dense.interfaces  = renumbered(frame.interfaces, order);
  for (const auto &output : frame.outputs)
    dense.outputs.push_back({output.name, output.unit, output.on_q(order), output.on_v(order)});
  dense.translations_load = (M * frame.translations)(order, Eigen::all);
  dense.total_mass        = frame.translations.transpose() * M * frame.translations;
  add_modes(dense, frame.modal_damping_ratio);
  return dense;
}

} // namespace gestell::coupling
