#include "coupling/dense_frame.h"

#include "coupling/dense_modes.h"

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

/// Unit diagonal makes metres and radians comparable; files written with 10 digits pass.
void require_semidefinite_stiffness(const MatrixXd &C)
{
  const VectorXd d =
      C.diagonal().unaryExpr([](double c) { return c != 0. && std::isfinite(c) ? 1. / std::sqrt(std::abs(c)) : 1.; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> scaled(d.asDiagonal() * C * d.asDiagonal(), Eigen::EigenvaluesOnly);
  if (scaled.eigenvalues().minCoeff() < -1e-8)
    throw std::invalid_argument("stiffness: has a negative eigenvalue; a frame at rest cannot push itself away");
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

  require_semidefinite_stiffness(C);
  const DenseModes modes = dense_modes(C, M);
  const MatrixXd   Z     = (M * modes.V)(order, Eigen::all);
  dense.B += Z * (2. * frame.modal_damping_ratio * modes.omega).asDiagonal() * Z.transpose();
  dense.frequencies_hz  = modes.omega / (2. * M_PI);
  dense.frequency_error = VectorXd::Zero(modes.omega.size());
  return dense;
}

} // namespace gestell::coupling
