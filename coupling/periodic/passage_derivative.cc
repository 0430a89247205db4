#include "coupling/periodic/passage_derivative.h"

#include "coupling/integration/system/dense_solvers.h"

#include <cmath>
#include <random>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
} // namespace

MatrixXd PassageDerivative::monodromy(Index size, const Map &map)
{
  MatrixXd Phi;
  condensed_ = V_.size() > 0 && V_.cols() < size;
  if (condensed_)
  {
    std::mt19937                     random(1); // the same in every call: a motion has one matrix
    std::normal_distribution<double> normal;
    VectorXd                         across = VectorXd::NullaryExpr(size, [&](Index) { return normal(random); });
    MatrixXd                         X(size, V_.cols() + 1);
    X << V_, across.normalized();
    const auto [all, images] = map(X);
    const MatrixXd D         = all.leftCols(V_.cols());
    Phi                      = images.leftCols(V_.cols()) * lu_solution(D.transpose() * D, D.transpose());
    // A random direction has 1/sqrt(size) of each of the others.
    condensed_ = (images - Phi * all).rightCols(1).norm() * std::sqrt(double(size)) <= 10. * left_out;
  }
  if (!condensed_)
    Phi = map(MatrixXd::Identity(size, size)).images;
  const SymmetricEigenSolver squares(Phi.transpose() * Phi);
  const Index                kept = (squares.eigenvalues().array() > left_out * left_out).count();
  V_                              = squares.eigenvectors().rightCols(kept);
  return Phi;
}

} // namespace gestell::coupling
