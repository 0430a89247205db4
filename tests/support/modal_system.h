#pragma once

#include "tests/support/small_system.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace gestell::tests
{

/// With the modes of its base system.
class ModalSystem : public SmallSystem
{
public:
  using SmallSystem::SmallSystem;

  std::vector<coupling::SpectrumLine> spectrum() const override
  {
    const auto                          n = M.rows();
    std::vector<coupling::SpectrumLine> lines;
    Matrix                              A = Matrix::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n)      = -M.inverse() * C;
    A.bottomRightCorner(n, n)     = -M.inverse() * B;
    const Eigen::VectorXcd values = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
    for (const std::complex<double> &s : values)
      if (s.imag() >= 0.)
        lines.push_back({std::abs(s), std::abs(s) > 0. ? -s.real() / std::abs(s) : 0.});
    return lines;
  }
};

/// m x'' + c x' + k x = 0 and a law; its mode is told.
inline ModalSystem oscillator(double m, double c, double k, SmallSystem::Law law)
{
  ModalSystem system(Eigen::MatrixXd::Constant(1, 1, m), Eigen::MatrixXd::Constant(1, 1, c),
                     Eigen::MatrixXd::Constant(1, 1, k));
  system.set_law(Eigen::VectorXd::Ones(1), std::move(law));
  return system;
}

/// x'' + a x + b x^3 = 0
inline ModalSystem duffing(double a, double b)
{
  return oscillator(1., 0., a,
                    law_of([b](double u) { return -b * u * u * u; }, [b](double u) { return -3. * b * u * u; }));
}

} // namespace gestell::tests
