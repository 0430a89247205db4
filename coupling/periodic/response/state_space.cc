#include "coupling/periodic/response/state_space.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/periodic/response/linearised_system.h"

#include <Eigen/Dense>

#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{
namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns that span G q = 0, of coordinates scaled by their masses.
MatrixXd free_of(const MatrixXd &G, const MatrixXd &M)
{
  VectorXd scale = VectorXd::Ones(M.rows());
  for (Index i = 0; i < M.rows(); ++i)
    if (M(i, i) > 0.)
      scale[i] = 1. / std::sqrt(M(i, i));
  MatrixXd rows = G * scale.asDiagonal();
  for (Index e = 0; e < rows.rows(); ++e)
    if (const double size = rows.row(e).norm(); size > 0.)
      rows.row(e) /= size;
  constexpr double dependent_rows = 1e-10; // of G, relative
  return scale.asDiagonal() * LeastSquaresSolver(rows, dependent_rows).null_space();
}

/// M_r^-1 R; rows and columns of M_r are scaled to a unit diagonal.
MatrixXd divided_by_mass(const MatrixXd &M_r, const MatrixXd &R)
{
  VectorXd scale = M_r.diagonal();
  for (double &size : scale)
  {
    if (!(size > 0.))
      throw std::invalid_argument(
          "a coordinate has no mass, such as the state of a drive or a massless point of the frame: the machine has no "
          "form x' = A x + B u; give it mass, or use its frequency responses");
    size = 1. / std::sqrt(size);
  }
  Eigen::FullPivLU<MatrixXd> lu(scale.asDiagonal() * M_r * scale.asDiagonal());
  constexpr double           least_mass = 1e-13; // pivot of M_r at unit diagonal
  lu.setThreshold(least_mass);
  if (!lu.isInvertible())
    throw std::invalid_argument("a motion has no mass, although each coordinate has: the machine has no form x' = A x "
                                "+ B u; give it mass, or use its frequency responses");
  return scale.asDiagonal() * lu.solve(scale.asDiagonal() * R);
}

/// A quantity of the machine, linear in x and u.
struct Linear
{
  MatrixXd x, u;
};

Linear times(const MatrixXd &factor, const Linear &of)
{
  return {factor * of.x, factor * of.u};
}

void add(const VectorXd &weights, const Linear &of, Index row, StateSpace &system)
{
  if (weights.size() == 0)
    return;
  system.C.row(row) += weights.transpose() * of.x;
  system.D.row(row) += weights.transpose() * of.u;
}

} // namespace

StateSpace state_space(const LinearResponse &machine, const MatrixXd &forces, const std::vector<LinearAnswer> &answers)
{
  const LinearisedSystem &parts = machine.parts();
  const MatrixXd W = parts.W, M = parts.M + W * parts.M_u * W.transpose(), B = parts.B + W * parts.B_u * W.transpose(),
                 C = parts.C + W * parts.K_u * W.transpose();
  const MatrixXd G = parts.E * W.transpose();
  StateSpace     system;
  system.bound = G.rows() > 0;
  system.Z     = system.bound ? free_of(G, M) : MatrixXd::Identity(M.rows(), M.rows());

  const MatrixXd &Z = system.Z;
  const Index     m = Z.cols(), n_in = forces.cols();
  MatrixXd        right(m, 2 * m + n_in);
  right << -(Z.transpose() * C * Z), -(Z.transpose() * B * Z), Z.transpose() * forces;
  const MatrixXd r2             = divided_by_mass(Z.transpose() * M * Z, right); // r'' of x and u
  system.A                      = MatrixXd::Zero(2 * m, 2 * m);
  system.A.topRightCorner(m, m) = MatrixXd::Identity(m, m);
  system.A.bottomRows(m)        = r2.leftCols(2 * m);
  system.B                      = MatrixXd::Zero(2 * m, n_in);
  system.B.bottomRows(m)        = r2.rightCols(n_in);

  Linear q{MatrixXd::Zero(Z.rows(), 2 * m), MatrixXd::Zero(Z.rows(), n_in)}, v = q;
  q.x.leftCols(m)  = Z;
  v.x.rightCols(m) = Z;
  const Linear a{Z * r2.leftCols(2 * m), Z * r2.rightCols(n_in)};
  Linear       mu{MatrixXd::Zero(parts.E.rows(), 2 * m), MatrixXd::Zero(parts.E.rows(), n_in)};
  if (system.bound)
  {
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> balance(G.transpose());
    mu = {balance.solve(M * a.x + B * v.x + C * q.x), balance.solve(M * a.u - forces)};
  }
  const Linear u = times(W.transpose(), q), u1 = times(W.transpose(), v), u2 = times(W.transpose(), a);
  const Linear p{-(parts.K_u * u.x + parts.B_u * u1.x + parts.M_u * u2.x) + parts.E.transpose() * mu.x,
                 -(parts.M_u * u2.u) + parts.E.transpose() * mu.u};
  const Linear lambda{mu.x.topRows(parts.n_c), mu.u.topRows(parts.n_c)};

  system.C = MatrixXd::Zero(Index(answers.size()), 2 * m);
  system.D = MatrixXd::Zero(Index(answers.size()), n_in);
  for (Index i = 0; i < Index(answers.size()); ++i)
  {
    const LinearAnswer &answer = answers[std::size_t(i)];
    add(answer.q, q, i, system);
    add(answer.v, v, i, system);
    add(answer.a, a, i, system);
    add(answer.p, p, i, system);
    add(answer.lambda, lambda, i, system);
  }
  return system;
}

} // namespace gestell::coupling
