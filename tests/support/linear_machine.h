#pragma once

#include "coupling/periodic/response/linear_response.h"

#include <Eigen/Dense>

#include <random>

namespace gestell::tests
{

/// A machine that is linear altogether: p = -K u - D u' - N u'', G u = 0.
class LinearMachine final : public coupling::SecondOrderSystem, coupling::LinearSystem, coupling::LocalForces
{
public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  Matrix           M, B, C, W, K, D, N, G;
  std::vector<int> lags;

  explicit LinearMachine(Eigen::Index n, Eigen::Index n_u)
      : M(Matrix::Zero(n, n)), B(M), C(M), W(n, n_u), K(Matrix::Zero(n_u, n_u)), D(K), N(K), G(0, n_u),
        excitation_(int(n))
  {
  }

  void finish()
  {
    sparse_W_ = W.sparseView();
    joints_.G = G;
    if (G.rows() > 0)
      joints_.all = {{0, int(G.rows()), 0, int(G.cols()), 1.}};
  }

  const coupling::LinearSystem &linear() const override { return *this; }
  const coupling::LocalForces  &forces() const override { return *this; }
  const coupling::IdealJoints  &joints() const override { return joints_; }

private:
  int                                     size() const override { return int(M.rows()); }
  void                                    mass_times(const Vector &x, Vector &y) const override { y = M * x; }
  void                                    damping_times(const Vector &x, Vector &y) const override { y = B * x; }
  void                                    stiffness_times(const Vector &x, Vector &y) const override { y = C * x; }
  std::unique_ptr<coupling::LinearSolver> factorise(double, double, double) const override { return nullptr; }
  std::vector<coupling::SpectrumLine>     spectrum() const override { return {}; }
  const coupling::Excitation             &excitation() const override { return excitation_; }
  bool                                    dense_matrices(Matrix &m, Matrix &b, Matrix &c) const override
  {
    m = M, b = B, c = C;
    return true;
  }
  const std::vector<int> &virtual_coordinates() const override { return lags; }
  std::string             coordinate_name(int i) const override { return "q" + std::to_string(i); }

  const Eigen::SparseMatrix<double> &directions() const override { return sparse_W_; }
  void force(const coupling::LocalState &at, Vector &p) const override { p = -K * at.u - D * at.v - N * at.a; }
  void tangent(const coupling::LocalState &at, double w_u, double w_v, double w_a, Vector &p, Matrix &dp) const override
  {
    force(at, p);
    dp = -w_u * K - w_v * D - w_a * N;
  }
  void derivatives(const coupling::LocalState &at, Vector &p, Matrix &du, Matrix &dv) const override
  {
    force(at, p);
    du = -K, dv = -D;
  }

  struct Joints final : coupling::IdealJoints
  {
    Matrix                                 G;
    std::vector<coupling::ConstraintBlock> all;

    const std::vector<coupling::ConstraintBlock> &blocks() const override { return all; }
    void constraints(const coupling::LocalState &at, Vector &g, coupling::ConstraintJacobian &jacobian) const override
    {
      g           = G * at.u;
      jacobian[0] = G;
    }
  };

  coupling::Excitation        excitation_;
  Eigen::SparseMatrix<double> sparse_W_;
  Joints                      joints_;
};

inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index cols, std::mt19937 &dice)
{
  std::uniform_real_distribution<double> number(-1., 1.);
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return number(dice); });
}

inline Eigen::MatrixXd positive(Eigen::Index n, std::mt19937 &dice)
{
  const Eigen::MatrixXd A = random_matrix(n, n, dice);
  return A * A.transpose() + 0.1 * double(n) * Eigen::MatrixXd::Identity(n, n);
}

/// Masses of kilograms on springs of 1e4 N/m, dampers that couple modes; elements a hundred times as stiff.
inline LinearMachine random_machine(unsigned seed, Eigen::Index n = 9, Eigen::Index n_u = 4)
{
  std::mt19937  dice(seed);
  LinearMachine machine(n, n_u);
  machine.M = positive(n, dice);
  machine.B = 3. * positive(n, dice);
  machine.C = 1e4 * positive(n, dice);
  machine.W = random_matrix(n, n_u, dice);
  machine.K = 1e6 * positive(n_u, dice);
  machine.D = 20. * positive(n_u, dice);
  machine.N = 0.2 * positive(n_u, dice);
  machine.finish();
  return machine;
}

inline coupling::LinearResponse response_of(const LinearMachine &machine)
{
  coupling::OperatingPoint at;
  at.local.resize(machine);
  return {machine, at};
}

} // namespace gestell::tests
