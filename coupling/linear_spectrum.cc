#include "coupling/linear_spectrum.h"

#include "coupling/dense_matrices.h"
#include "coupling/dense_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

/// Complex eigenvalues of the modes with damping V^T B V, as lines by ascending frequency.  In the state
/// (Omega y, y') the matrix is as large as the highest frequency, so that the lowest keep their digits.
std::vector<SpectrumLine> damped_lines(const DenseModes &modes, const Eigen::MatrixXd &B)
{
  const Eigen::Index p = modes.omega.size();
  if (p == 0) // nothing has mass
    return {};
  Eigen::MatrixXd A(2 * p, 2 * p);
  A << Eigen::MatrixXd::Zero(p, p), Eigen::MatrixXd(modes.omega.asDiagonal()),
      Eigen::MatrixXd((-modes.omega).asDiagonal()), -modes.V.transpose() * B * modes.V;
  const Eigen::VectorXcd    s     = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  const double              noise = 1e-9 * s.cwiseAbs().maxCoeff();
  std::vector<SpectrumLine> lines;
  for (const std::complex<double> &value : s)
    if (value.imag() > std::max(noise, 1e-9 * std::abs(value)))
      lines.push_back({std::abs(value), -value.real() / std::abs(value)});
  std::sort(lines.begin(), lines.end(), [](const SpectrumLine &a, const SpectrumLine &b) { return a.omega < b.omega; });
  return lines;
}

/// Modes of (M, B, C); K [n x n] is the part of C that engaged elements contribute, empty if none.
void add_modes(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C, const Eigen::MatrixXd &K,
               ModeOrigin origin, DampingRule rule, std::vector<LinearMode> &result)
{
  const DenseModes modes      = dense_modes(C, M);
  const auto       contact_of = [&](Eigen::Index j)
  {
    const auto v = modes.V.col(j);
    return K.size() > 0 ? std::sqrt(std::max(0., v.dot(K * v))) : 0.;
  };
  const auto p = modes.omega.size();
  if (rule == DampingRule::diagonal)
  {
    for (Eigen::Index j = 0; j < p; ++j)
      if (const double omega = modes.omega[j]; omega > 0.)
        result.push_back({origin,
                          static_cast<int>(j) + 1,
                          {omega, modes.V.col(j).dot(B * modes.V.col(j)) / (2. * omega)},
                          contact_of(j)});
    return;
  }
  Eigen::Index nearest = 0;
  for (const SpectrumLine &line : damped_lines(modes, B))
  {
    while (nearest + 1 < p &&
           std::abs(modes.omega[nearest + 1] - line.omega) <= std::abs(modes.omega[nearest] - line.omega))
      ++nearest;
    result.push_back({origin, static_cast<int>(nearest) + 1, line, contact_of(nearest)});
  }
}

/// The highest frequency by power iteration on M^-1 C, approached from below; two hundred steps come within a per cent.
LinearMode highest_mode(const Machine &machine, double damping_ratio)
{
  const auto      mass = machine.factorise(1., 0., 0.);
  Eigen::VectorXd x    = Eigen::VectorXd::LinSpaced(machine.size(), -1., 1.), y(x.size()), z(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = std::cos(1.7 * double(i) * double(i)); // rough, so that no high mode is missed
  double omega = 0.;
  for (int i = 0; i < 200; ++i)
  {
    machine.stiffness_times(x, y);
    machine.mass_times(x, z);
    omega = std::sqrt(std::max(0., x.dot(y) / x.dot(z)));
    mass->solve(y, x);
    x /= x.norm();
  }
  return {ModeOrigin::base, machine.size(), {omega, damping_ratio}, 0., true};
}

std::vector<LinearMode> modes_of_large(const Machine &machine)
{
  std::vector<LinearMode>         result;
  const std::vector<SpectrumLine> lines  = machine.spectrum();
  int                             number = 0;
  double                          least  = 1.;
  for (const SpectrumLine &line : lines)
  {
    ++number;
    if (line.omega <= 0.)
      continue;
    result.push_back({ModeOrigin::base, number, line, 0.});
    least = std::min(least, line.zeta);
  }
  if (number < machine.size())
    result.push_back(highest_mode(machine, std::max(0., least)));
  return result;
}

} // namespace

std::vector<LinearMode> linear_modes(const Machine &machine, const Eigen::VectorXd &q, DampingRule rule)
{
  Eigen::MatrixXd M, B, C, K, D;
  if (machine.full_frame() || !machine.dense_matrices(M, B, C))
    return modes_of_large(machine);
  std::vector<LinearMode> result;
  add_modes(M, B, C, {}, ModeOrigin::base, rule, result);
  stiffest_matrices(machine, q, K, D);
  if (!K.isZero(0.) || !D.isZero(0.))
    add_modes(M, B + D, C + K, K, ModeOrigin::closed, rule, result);
  return result;
}

} // namespace gestell::coupling
