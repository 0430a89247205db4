#include "coupling/simulation/checks/step_roots.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int most_degree = 3; ///< of step weights in r: Wilson's

/// Coefficients of r^0, r^1 ...: columns of mass, damping and stiffness by their values at four r.
Eigen::Matrix<double, most_degree + 1, 3> coefficients(const MethodOptions &options)
{
  Eigen::Matrix4d                           powers;
  Eigen::Matrix<double, most_degree + 1, 3> values;
  for (int i = 0; i <= most_degree; ++i)
  {
    const double      r = i - 1.;
    const StepWeights w = *method_of(options).step_weights(options, r);
    values.row(i) << w.mass, w.damping, w.stiffness;
    powers.row(i) << 1., r, r * r, r * r * r;
  }
  return powers.inverse() * values;
}

/// max Re s of the machine; 0 if nothing grows.
double own_growth(const LinearMachine &machine)
{
  return std::max(0., damped_roots(machine.modes, machine.C, machine.B).real().maxCoeff());
}

} // namespace

std::optional<GrowingMotion> growing_step(const LinearMachine &machine, const MethodOptions &options, double h)
{
  const Index p = machine.C.rows();
  if (p == 0)
    return {};
  const auto       w         = coefficients(options);
  constexpr double no_weight = 1e-14; // a coefficient that is rounding of sums of a few terms of order one
  int              n         = most_degree;
  while (n > 1 && std::abs(w(n, 0)) < no_weight)
    --n;
  std::vector<MatrixXd> P;
  for (int k = 0; k <= n; ++k)
    P.emplace_back(w(k, 0) * MatrixXd::Identity(p, p) + (w(k, 1) * h) * machine.B + (w(k, 2) * h * h) * machine.C);
  MatrixXd companion = MatrixXd::Zero(n * p, n * p);
  companion.topRightCorner((n - 1) * p, (n - 1) * p).setIdentity();
  for (int k = 0; k < n; ++k)
    companion.block((n - 1) * p, k * p, p, p) = -lu_solution(P[std::size_t(n)], P[std::size_t(k)]);
  if (!companion.allFinite()) // the last power has no inverse: a motion of r = infinity
    return GrowingMotion{std::numeric_limits<double>::infinity(), Eigen::VectorXd::Ones(p)};
  const GeneralEigenSolver solver(companion);
  Index                    fastest;
  const double             radius = solver.eigenvalues().cwiseAbs().maxCoeff(&fastest);
  // Growth of a step that is only rounding: for a motion at rest (r = 1) and a stiff one (r = -1) there is a double
  // root, which rounding splits by its root, 1e-8, times their condition. At a limit of the step |r| grows with the
  // root of the excess.
  constexpr double harmless_of_double = 1e-6;
  if (std::log(radius) <= 2. * own_growth(machine) * h + harmless_of_double)
    return {};
  return GrowingMotion{radius, solver.eigenvectors().col(fastest).head(p).cwiseAbs()};
}

} // namespace gestell::coupling
