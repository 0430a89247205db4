#include "coupling/machine/own_modes.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/algebra/diagonal_and_rank.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rounding = 1e-10; // of modes

/// Roots of the diagonal of A, by which its entries are judged.
VectorXd scale_of(const MatrixXd &A)
{
  constexpr double least = 1e-3; // of the largest damping: that of free and undamped modes is rounding
  const VectorXd   size  = A.diagonal().cwiseAbs();
  return size.cwiseMax(least * size.maxCoeff()).cwiseSqrt();
}

/// Whether A has no entries beside its diagonal, up to rounding.
bool decouples(const MatrixXd &A)
{
  const VectorXd scale = scale_of(A);
  const MatrixXd rest  = A - MatrixXd(A.diagonal().asDiagonal());
  return (rest.array().abs() <= rounding * (scale * scale.transpose()).array()).all();
}

/// The damping B of the modes: d, and the dampers between them.
std::optional<DiagonalAndRank> dampers_between(const MatrixXd &B, Index most)
{
  const VectorXd scale = scale_of(B);
  if (!(scale.maxCoeff() > 0.))
    return DiagonalAndRank{VectorXd::Zero(B.rows()), MatrixXd(B.rows(), 0), {}};
  const VectorXd inverse = scale.cwiseInverse();
  auto           parts   = diagonal_and_rank(inverse.asDiagonal() * B * inverse.asDiagonal(), rounding, most);
  if (parts)
  {
    parts->diagonal.array() *= scale.array().square();
    parts->G = (scale.asDiagonal() * parts->G).eval();
  }
  return parts;
}

/// The same modes with signs that depend on their shape at the interface V_1 alone.
void fix_signs(MatrixXd &V, Index n1)
{
  for (Index j = 0; j < V.cols(); ++j)
  {
    Index largest = 0;
    V.col(j).head(n1).cwiseAbs().maxCoeff(&largest);
    if (V(largest, j) < 0.)
      V.col(j) = -V.col(j);
  }
}

/// Modes a that move q1 independently, the lowest where there is a choice: forces are then small differences. Weights
/// are flexibilities.
std::vector<Index> modes_of_interface(const MatrixXd &V_1, const VectorXd &omega)
{
  const double low     = omega.maxCoeff() * 1e-3; // rigid-body modes come first, but not infinitely so
  MatrixXd     weighed = V_1 * (omega.array() + low).inverse().matrix().asDiagonal();
  weighed.rowwise().normalize();
  const auto         order = weighed.colPivHouseholderQr().colsPermutation().indices();
  std::vector<Index> first(order.data(), order.data() + V_1.rows());
  std::sort(first.begin(), first.end());
  return first;
}

/// Dampers with which a step in own modes is still cheaper than one with the stored inverse.
Index most_dampers(Index n1, Index m)
{
  constexpr Index share = 4; // measured for n1 = 12, m = 200: n1 + k = 48 needs 3/4 of the time, 70 as much
  return std::max<Index>(m / share - n1, 0);
}

void turn_rows(ReducedFrame &frame, const MatrixXd &X)
{
  const Index n = X.rows();
  for (MatrixXd *A : {&frame.M, &frame.B, &frame.C})
  {
    *A = (X.transpose() * *A * X).eval();
    *A = (0.5 * (*A + A->transpose())).eval();
  }
  frame.translations_load = (X.transpose() * frame.translations_load).eval();
  for (fem::FrameOutput &output : frame.outputs)
    for (VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      if (row->size() > 0)
        *row = (X.transpose() * *row).eval();
  const Eigen::MatrixXf single = X.cast<float>();
  if (frame.displacement.rows() > 0)
    frame.displacement = (frame.displacement * single).eval();
  for (Eigen::MatrixXf *stress : {&frame.stress.mean, &frame.stress.deviation})
    if (stress->rows() > 0)
      stress->leftCols(n) = (stress->leftCols(n) * single).eval();
}

} // namespace

std::optional<OwnModes> turn_to_own_modes(ReducedFrame &frame)
{
  constexpr Index many = 64; // fixed-interface modes: for fewer, one product with the stored inverse is as fast
  const Index     n = frame.M.rows(), n1 = frame.n_interface, m = n - n1;
  if (!frame.modal || n1 == 0 || m < many || decouples(frame.B.bottomRightCorner(m, m)))
    return {};
  DenseModes own = dense_modes(frame.C, frame.M, cancelled_by_reduction, frame.n_rigid());
  if (own.omega.size() < n)
    return {};
  fix_signs(own.V, n1);
  const auto damping = dampers_between(own.V.transpose() * frame.B * own.V, most_dampers(n1, m));
  if (!damping)
    return {};
  const std::vector<Index> a     = modes_of_interface(own.V.topRows(n1), own.omega);
  std::vector<Index>       order = a;
  for (Index j = 0; j < n; ++j)
    if (!std::binary_search(a.begin(), a.end(), j))
      order.push_back(j);
  const MatrixXd V = own.V(Eigen::all, order), G = damping->G(order, Eigen::all);
  const Index    k = G.cols(), n_a = n1 + k;

  OwnModes modes;
  modes.S.resize(n_a, n1);
  modes.R.resize(n_a, m);
  modes.S.topRows(n1)   = V.topLeftCorner(n1, n1).inverse();
  modes.R.topRows(n1)   = modes.S.topRows(n1) * V.topRightCorner(n1, m);
  modes.S.bottomRows(k) = G.topRows(n1).transpose() * modes.S.topRows(n1);
  modes.R.bottomRows(k) = G.topRows(n1).transpose() * modes.R.topRows(n1) - G.bottomRows(m).transpose();
  const auto of_all     = [&](const VectorXd &own_values, const VectorXd &of_dampers)
  {
    VectorXd all(n_a + m);
    all << VectorXd(own_values(order)).head(n1), of_dampers, VectorXd(own_values(order)).tail(m);
    return all;
  };
  modes.masses  = of_all(VectorXd::Ones(n), VectorXd::Zero(k));
  modes.damping = of_all(damping->diagonal, damping->signs);
  modes.squares = of_all(own.omega.cwiseAbs2(), VectorXd::Zero(k));
  MatrixXd X(n, n);
  X.leftCols(n1) = V.leftCols(n1) * modes.S.topRows(n1);
  X.rightCols(m) = V.rightCols(m) - V.leftCols(n1) * modes.R.topRows(n1);
  X.topRows(n1)  = MatrixXd::Identity(n1, n);
  turn_rows(frame, X);
  return modes;
}

FixedModeCoordinates fixed_mode_coordinates(const ReducedFrame &frame)
{
  constexpr double rounding = 1e-10; // of C between q1 and modes
  const Index      n = frame.M.rows(), n1 = frame.n_interface, m = n - n1;
  const MatrixXd   C_L1 = frame.C.bottomLeftCorner(m, n1), C_LL = frame.C.bottomRightCorner(m, m);
  if (!frame.modal || !(C_L1.norm() > rounding * C_LL.norm()))
    return {{}, {}, frame.omega0};
  const MatrixXd   M_LL  = frame.M.bottomRightCorner(m, m);
  const DenseModes fixed = dense_modes(C_LL, M_LL);
  if (fixed.omega.size() < m || !(fixed.omega.minCoeff() > 0.))
    return {{}, {}, frame.omega0};
  const MatrixXd Psi = -fixed.V * fixed.omega.cwiseAbs2().cwiseInverse().asDiagonal() * (fixed.V.transpose() * C_L1);
  const MatrixXd V_inverse = fixed.V.transpose() * M_LL;

  FixedModeCoordinates to{MatrixXd::Identity(n, n), MatrixXd::Identity(n, n), fixed.omega};
  to.T.bottomLeftCorner(m, n1)       = Psi;
  to.T.bottomRightCorner(m, m)       = fixed.V;
  to.inverse.bottomLeftCorner(m, n1) = -V_inverse * Psi;
  to.inverse.bottomRightCorner(m, m) = V_inverse;
  return to;
}

} // namespace gestell::coupling
