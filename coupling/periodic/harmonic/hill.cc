#include "coupling/periodic/harmonic/hill.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// A_k of the neighbourhood of the motion, k >= 0 [2n x 2n].
class Neighbourhood
{
public:
  Neighbourhood(const PeriodicProblem &problem, double omega,
                const std::vector<HarmonicForces::Derivative> &derivatives)
      : omega_(omega), derivatives_(derivatives)
  {
    MatrixXd M, B, C;
    if (!problem.system->linear().dense_matrices(M, B, C))
      throw std::invalid_argument("Hill's matrix: the base system is not dense; use a shooting pass");
    const Eigen::LLT<MatrixXd> mass(M);
    if (mass.info() != Eigen::Success)
      throw std::invalid_argument("Hill's matrix: the mass matrix is singular; use a shooting pass");
    for (const HarmonicForces::Derivative &d : derivatives)
      if (d.of_a.size() > 0)
        throw std::invalid_argument("Hill's matrix: forces depend on accelerations; use a shooting pass");
    damping_   = -mass.solve(B) / omega;
    stiffness_ = -mass.solve(C) / (omega * omega);
    W_         = MatrixXd(problem.system->forces().directions());
    put_       = mass.solve(W_);
  }

  Eigen::Index n() const { return damping_.rows(); }

  MatrixXcd at(int k) const
  {
    MatrixXcd of_u = MatrixXcd::Zero(W_.cols(), W_.cols()), of_v = of_u;
    for (const HarmonicForces::Derivative &d : derivatives_)
    {
      of_u(d.i, d.j) = k < d.of_u.size() ? d.of_u[k] : 0.;
      of_v(d.i, d.j) = k < d.of_v.size() ? d.of_v[k] : 0.;
    }
    MatrixXcd A                   = MatrixXcd::Zero(2 * n(), 2 * n());
    A.bottomLeftCorner(n(), n())  = put_ * of_u * W_.transpose() / (omega_ * omega_);
    A.bottomRightCorner(n(), n()) = put_ * of_v * W_.transpose() / omega_;
    if (k > 0)
      return A;
    A.topRightCorner(n(), n()).setIdentity();
    A.bottomLeftCorner(n(), n()) += stiffness_;
    A.bottomRightCorner(n(), n()) += damping_;
    return A;
  }

private:
  double                                         omega_;
  const std::vector<HarmonicForces::Derivative> &derivatives_;
  MatrixXd                                       damping_, stiffness_, W_, put_;
};

/// Hill's matrix for x = x_0 + sum_k (c_k cos k phi + s_k sin k phi), real: rows x_0, c_1, s_1, ...
MatrixXd hill_matrix(const Neighbourhood &near, int N)
{
  const auto             m = 2 * near.n();
  std::vector<MatrixXcd> A;
  for (int k = 0; k <= 2 * N; ++k)
    A.push_back(near.at(k));
  const auto at    = [&A](int k) -> MatrixXcd { return k >= 0 ? A[k] : MatrixXcd(A[-k].conjugate()); };
  const auto place = [m](int k, int sine) { return k == 0 ? 0 : m * (2 * k - 1 + sine); };
  MatrixXd   H     = MatrixXd::Zero(m * (2 * N + 1), m * (2 * N + 1));
  const auto put   = [&](int k, Eigen::Index column, const MatrixXcd &a)
  {
    H.block(place(k, 0), column, m, m) = (k == 0 ? 1. : 2.) * a.real();
    if (k > 0)
      H.block(place(k, 1), column, m, m) = -2. * a.imag();
  };
  for (int k = 0; k <= N; ++k)
  {
    put(k, 0, at(k));
    for (int l = 1; l <= N; ++l)
    {
      put(k, place(l, 0), 0.5 * (at(k - l) + at(k + l)));
      put(k, place(l, 1), Complex(0., -0.5) * (at(k - l) - at(k + l)));
    }
    if (k == 0)
      continue;
    H.block(place(k, 0), place(k, 1), m, m) -= k * MatrixXd::Identity(m, m);
    H.block(place(k, 1), place(k, 0), m, m) += k * MatrixXd::Identity(m, m);
  }
  return H;
}

/// Monodromy matrix of exp(2 pi H) from x_0 alone, by the eigenvectors of H; and the size of its outermost harmonics.
MatrixXd projected(const MatrixXd &H, Eigen::Index m, double &outside)
{
  const GeneralEigenSolver solver(H);
  if (!solver.converged())
    throw std::invalid_argument("Hill's matrix: its eigenvalues were not found; use a shooting pass");
  MatrixXcd start = MatrixXcd::Zero(H.rows(), m);
  start.topRows(m).setIdentity();
  const MatrixXcd shares = solver.eigenvectors().partialPivLu().solve(start);
  const VectorXcd growth = (2. * M_PI * solver.eigenvalues()).array().exp();
  const MatrixXd  end    = (solver.eigenvectors() * growth.asDiagonal() * shares).real();
  MatrixXd        sum    = end.topRows(m);
  for (Eigen::Index first = m; first < H.rows(); first += 2 * m)
    sum += end.middleRows(first, m);
  outside = end.bottomRows(4 * m).cwiseAbs().maxCoeff() / std::max(1e-300, end.cwiseAbs().maxCoeff());
  return sum;
}

} // namespace

HillMultipliers hill_multipliers(const PeriodicProblem &problem, double omega, int harmonics,
                                 const std::vector<HarmonicForces::Derivative> &derivatives)
{
  const Neighbourhood near(problem, omega, derivatives);
  const auto          m = 2 * near.n();
  HillMultipliers     result;
  MatrixXd            monodromy;
  constexpr int       largest_rows = 800; // eigenvalues of so many take some seconds
  for (int N = std::max(4, harmonics); result.harmonics == 0 || m * (2 * N + 1) <= largest_rows; N += (N + 1) / 2)
  {
    monodromy                      = projected(hill_matrix(near, N), m, result.left_out);
    result.harmonics               = N;
    constexpr double small_outside = 1e-11; // share of the projections on rest harmonics: rounding of their sums
    if (result.left_out < small_outside)
      break;
  }
  result.multipliers = GeneralEigenSolver(monodromy, WithVectors::no).eigenvalues();
  std::stable_sort(result.multipliers.begin(), result.multipliers.end(),
                   [](Complex a, Complex b) { return std::abs(a) > std::abs(b); });
  return result;
}

FloquetWay floquet_way(const PeriodicProblem &problem, int harmonics)
{
  constexpr int chosen_rows = 300; // chosen: their eigenvalues take 25 n^3 = 7e8 multiplications
  return 2. * problem.system->linear().size() * (2. * harmonics + 1.) <= chosen_rows ? FloquetWay::hill
                                                                                     : FloquetWay::shooting;
}

} // namespace gestell::coupling
