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

VectorXd energy_roots(const LinearSystem &linear, double omega)
{
  const Index n = linear.size();
  VectorXd    squares(2 * n), unit = VectorXd::Zero(n), column(n);
  for (Index i = 0; i < n; ++i)
  {
    unit[i] = 1.;
    linear.mass_times(unit, column);
    squares[n + i] = std::abs(column[i]);
    linear.stiffness_times(unit, column);
    squares[i] = std::abs(column[i]) + omega * omega * squares[n + i];
    unit[i]    = 0.;
  }
  return (squares.array() > 0.).select(squares, 1.).cwiseSqrt(); // without mass and stiffness: as it is
}

MatrixXd PassageDerivative::monodromy(Index size, const Map &map)
{
  MatrixXd Phi;
  condensed_ = V_.size() > 0 && V_.cols() < size;
  if (condensed_)
  {
    // Of a missing motion a random direction shows 1/sqrt(size), or little by chance: several, others in every call.
    constexpr Index                  several = 3;
    std::mt19937                     random(calls_);
    std::normal_distribution<double> normal;
    MatrixXd                         X(size, V_.cols() + several);
    X << V_, MatrixXd::NullaryExpr(size, several, [&](Index, Index) { return normal(random); });
    X.rightCols(several).colwise().normalize();
    const auto [D, images] = map(X);
    Phi = images.leftCols(V_.cols()) * lu_solution(V_.transpose() * D.leftCols(V_.cols()), V_.transpose());
    const MatrixXd missing = (images - Phi * D).rightCols(several);
    condensed_             = missing.colwise().norm().maxCoeff() * std::sqrt(double(size)) <= 10. * left_out;
  }
  ++calls_;
  if (!condensed_)
    Phi = map(MatrixXd::Identity(size, size)).images;
  const SymmetricEigenSolver squares(Phi.transpose() * Phi);
  const Index                kept = (squares.eigenvalues().array() > left_out * left_out).count();
  V_                              = squares.eigenvectors().rightCols(kept);
  return Phi;
}

} // namespace gestell::coupling
