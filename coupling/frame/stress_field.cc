#include "coupling/frame/stress_field.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace gestell::coupling
{

double von_mises(const Stress &s)
{
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * s.tail<3>().squaredNorm());
}

PrincipalStresses principal_stresses(const Stress &s)
{
  Eigen::Matrix3d S;
  S << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(S);
  PrincipalStresses result{solver.eigenvalues().reverse(), solver.eigenvectors().col(2)};
  Eigen::Index      largest;
  result.first.cwiseAbs().maxCoeff(&largest);
  if (result.first[largest] < 0.)
    result.first = -result.first;
  return result;
}

Eigen::VectorXd stress_state(const ReducedStress &stress, const Eigen::VectorXd &q, const std::array<double, 3> &g)
{
  const auto      n = stress.mean.cols() - 3;
  Eigen::VectorXd state(n + 3);
  state << q.head(n), g[0], g[1], g[2];
  return state;
}

StressField stress_field(const ReducedStress &stress, const Eigen::VectorXd &state)
{
  assert(state.size() == stress.mean.cols());
  const int   n = stress.n_points();
  StressField field;
  field.components.resize(6, n);
  // Column by column in double precision: terms of large rigid motions cancel.
  Eigen::Map<Eigen::VectorXd> sigma(field.components.data(), 6 * Eigen::Index(n));
  sigma.setZero();
  for (Eigen::Index j = 0; j < state.size(); ++j)
    sigma += state[j] * stress.mean.col(j).cast<double>();
  field.von_mises.resize(n);
  for (int i = 0; i < n; ++i)
    field.von_mises[i] = von_mises(field.at(i));
  return field;
}

double disagreement(const ReducedStress &stress, const Eigen::VectorXd &state, int point)
{
  const auto stress_of = [&](const Eigen::MatrixXf &rows, int i) -> Stress
  { return rows.middleRows<6>(6 * Eigen::Index(i)).cast<double>() * state; };

  std::set<int> around{point};
  for (const auto &triangle : stress.triangles)
    if (std::find(triangle.begin(), triangle.end(), point) != triangle.end())
      around.insert(triangle.begin(), triangle.end());
  double squares = 0.;
  for (const int i : around)
    squares += std::pow(von_mises(stress_of(stress.deviation, i)), 2);
  const double whole = von_mises(stress_of(stress.mean, point));
  return whole > 0. ? std::sqrt(squares / double(around.size())) / whole : 0.;
}

} // namespace gestell::coupling
