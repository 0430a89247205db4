#include "coupling/frame/principal_states.h"

#include "coupling/integration/system/dense_solvers.h"

namespace gestell::coupling
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

PrincipalStates principal_states(const MatrixXd &states, const MatrixXd &gram)
{
  // the largest of each coordinate, 1 where it never moves: units drop out
  const VectorXd scale   = states.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double z) { return z > 0. ? z : 1.; });
  const VectorXd inverse = scale.cwiseInverse();
  const SymmetricEigenSolver norm(scale.asDiagonal() * gram * scale.asDiagonal());
  const VectorXd             root   = norm.eigenvalues().cwiseMax(0.).cwiseSqrt();
  constexpr double           noise  = 1e-6; // of the largest root, whose square is rounding of the norm
  Index                      hidden = 0;    // ascending
  while (hidden < root.size() && root[hidden] <= noise * root[root.size() - 1])
    ++hidden;
  const Index    n       = root.size() - hidden;
  const MatrixXd vectors = norm.eigenvectors();
  const MatrixXd whitened =
      root.tail(n).asDiagonal() * vectors.rightCols(n).transpose() * inverse.asDiagonal(); // times z: |c|
  const SymmetricEigenSolver principal(whitened * (states * states.transpose()) * whitened.transpose());
  const MatrixXd             U = principal.eigenvectors().rowwise().reverse();
  MatrixXd                   to_components(root.size(), root.size());
  to_components << whitened.transpose() * U, inverse.asDiagonal() * vectors.leftCols(hidden);
  PrincipalStates result;
  result.basis.resize(root.size(), root.size());
  result.basis << vectors.rightCols(n) * root.tail(n).cwiseInverse().asDiagonal() * U, vectors.leftCols(hidden);
  result.basis      = scale.asDiagonal() * result.basis;
  result.components = states.transpose() * to_components;
  result.measured   = n;
  return result;
}

} // namespace gestell::coupling
