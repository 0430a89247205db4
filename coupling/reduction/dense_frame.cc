#include "coupling/reduction/dense_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/reduction/mode_ratios.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>
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
    interface.renumber([&](int i) { return new_index[std::size_t(i)]; });
  return interfaces;
}

/// Scaling to unit diagonal makes metres and radians comparable; the limit accepts files written with 10 digits.
void require_semidefinite_stiffness(const MatrixXd &C)
{
  const VectorXd d =
      C.diagonal().unaryExpr([](double c) { return c != 0. && std::isfinite(c) ? 1. / std::sqrt(std::abs(c)) : 1.; });
  const SymmetricEigenSolver scaled(d.asDiagonal() * C * d.asDiagonal(), WithVectors::no);
  if (scaled.eigenvalues().minCoeff() < -1e-8)
    throw std::invalid_argument(
        "stiffness: has a negative eigenvalue; the stiffness of a frame at rest must be positive semidefinite");
}

bool is_diagonal(const MatrixXd &A)
{
  return (A - MatrixXd(A.diagonal().asDiagonal())).cwiseAbs().maxCoeff() == 0.;
}

/// Whether the coordinates after the first n_1 are modal: M_LL = E, C_LL diagonal, C_LN = 0, as reductions write.
bool is_modal(const ReducedFrame &frame)
{
  const auto n_1 = frame.n_interface, m = int(frame.M.rows()) - n_1;
  if (m == 0)
    return false;
  const MatrixXd M_LL = frame.M.bottomRightCorner(m, m), C_LL = frame.C.bottomRightCorner(m, m);
  return is_diagonal(M_LL) && (M_LL.diagonal().array() - 1.).abs().maxCoeff() <= 1e-15 && is_diagonal(C_LL) &&
         (C_LL.diagonal().array() >= 0.).all() &&
         (n_1 == 0 || frame.C.bottomLeftCorner(m, n_1).cwiseAbs().maxCoeff() == 0.);
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
  dense.modal       = is_modal(dense);
  dense.n_full      = int(M.rows());
  dense.mass        = frame.mass;
  dense.statements  = frame.statements;
  dense.interfaces  = renumbered(frame.interfaces, order);
  for (auto output : frame.outputs)
  {
    output.on_q = VectorXd(output.on_q(order));
    output.on_v = VectorXd(output.on_v(order));
    if (output.on_a.size() > 0)
      output.on_a = VectorXd(output.on_a(order));
    dense.outputs.push_back(std::move(output));
  }
  dense.points    = frame.picture.points;
  dense.triangles = frame.picture.triangles;
  if (!dense.points.empty())
    dense.displacement = MatrixXd(frame.picture.displacement)(Eigen::all, order).cast<float>();
  dense.translations_load = (M * frame.translations)(order, Eigen::all);

  if (dense.modal)
  {
    dense.omega0          = dense.C.diagonal().tail(M.rows() - dense.n_interface).cwiseSqrt();
    dense.static_residual = std::numeric_limits<double>::quiet_NaN(); // of a reduction nothing is known of
  }

  require_semidefinite_stiffness(C);
  const DenseModes modes = dense_modes(C, M);
  dense.frequencies_hz   = modes.omega / (2. * M_PI);
  dense.frequency_error  = VectorXd::Zero(modes.omega.size());
  add_modal_damping(dense, frame.modal_damping_ratio);
  return dense;
}

MatrixXd unit_translations(const ReducedFrame &frame)
{
  const Eigen::LLT<MatrixXd> factor(frame.M);
  if (factor.info() == Eigen::Success)
    return factor.solve(frame.translations_load);
  return LeastSquaresSolver(frame.M).solve(frame.translations_load);
}

} // namespace gestell::coupling
