#include "coupling/machine/condensed_solver.h"

#include "coupling/algebra/packed_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

void refuse_singular(int coordinate)
{
  throw std::invalid_argument(
      "DenseBase: the matrix of the time step is singular at coordinate " + std::to_string(coordinate) +
      ", which has no mass, damping or stiffness of its own; add one of them, or remove the coordinate");
}

MatrixXd symmetric_inverse(const MatrixXd &A, const std::vector<int> &names)
{
  const auto n = A.rows();
  if (n == 0)
    return A;
  const VectorXd d =
      A.diagonal().unaryExpr([](double a) { return a != 0. && std::isfinite(a) ? 1. / std::sqrt(std::abs(a)) : 1.; });
  const MatrixXd             scaled = d.asDiagonal() * A * d.asDiagonal();
  MatrixXd                   X;
  const Eigen::LLT<MatrixXd> cholesky(scaled);
  constexpr double           regular = 1e-14; // smallest pivot of a matrix scaled to unit diagonal
  if (cholesky.info() == Eigen::Success && cholesky.matrixLLT().diagonal().cwiseAbs2().minCoeff() > regular)
    X = cholesky.solve(MatrixXd::Identity(n, n));
  else
  {
    Eigen::FullPivLU<MatrixXd> lu(scaled);
    lu.setThreshold(regular);
    if (!scaled.allFinite() || !lu.isInvertible())
    {
      int worst = 0;
      if (scaled.allFinite())
        lu.kernel().col(0).cwiseAbs().maxCoeff(&worst);
      refuse_singular(names[worst]);
    }
    X = lu.inverse();
  }
  X = (X * (2. * MatrixXd::Identity(n, n) - scaled * X)).eval();
  return d.asDiagonal() * (0.5 * (X + X.transpose())) * d.asDiagonal();
}

namespace
{

class CondensedSolver final : public LinearSolver
{
public:
  CondensedSolver(const CondensedMatrices &matrices, const ModalRange &L, const std::vector<int> &N)
      : L_(L), N_(N), inverse_LL_(matrices.A_LL.cwiseInverse()), M_LN_(matrices.M_LN), k_(matrices.A_LN.cols())
  {
    const auto &[A_NN, A_LN, A_LL, M_NN, M_LN] = matrices;
    const MatrixXd G                           = inverse_LL_.asDiagonal() * A_LN;
    MatrixXd       A                           = A_NN;
    MatrixXd       of_h                        = M_NN;
    A.topLeftCorner(k_, k_) -= A_LN.transpose() * G;
    of_h.topLeftCorner(k_, k_) -= G.transpose() * M_LN;
    const MatrixXd A_red_inverse = symmetric_inverse(A, N);
    A_red_inverse_               = PackedMatrix(A_red_inverse);
    of_h_                        = PackedMatrix(A_red_inverse * of_h);
    if (!find_multiple(A_LN, M_LN))
      A_LN_ = PackedMatrix(A_LN);
    for (VectorXd *x : {&x_N_, &h_N_, &f_N_})
      x->setZero(PackedMatrix::padded(A_NN.rows()));
    part_N_.setZero(k_);
    x_L_.setZero(L.n);
  }

  void solve(const VectorXd &f, VectorXd &x) const override
  {
    gather(f, N_, f_N_);
    x_L_ = inverse_LL_.cwiseProduct(f.segment(L_.first, L_.n));
    A_NL_times(x_L_, -1.);
    x_N_.setZero();
    A_red_inverse_.add_product(f_N_.data(), x_N_.data());
    scatter(x_N_, N_, x);
    auto x_L = x.segment(L_.first, L_.n);
    x_L      = f.segment(L_.first, L_.n);
    A_LN().add_product_within(x_N_.data(), x_L.data(), -multiple_);
    x_L.array() *= inverse_LL_.array();
  }

  const std::vector<int> &leading() const override { return N_; }

  void solve_leading(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    const auto h_L = h.segment(L_.first, L_.n), f_L = f.segment(L_.first, L_.n);
    gather(h, N_, h_N_);
    gather(f, N_, f_N_);
    if (is_multiple_)
    {
      x_L_ = h_L - multiple_ * inverse_LL_.cwiseProduct(h_L + f_L);
      M_LN_.add_transposed_product(x_L_.data(), f_N_.data());
    }
    else
    {
      M_LN_.add_transposed_product(h_L.data(), f_N_.data());
      x_L_ = inverse_LL_.cwiseProduct(h_L + f_L);
      A_NL_times(x_L_, -1.);
    }
    x_N_.setZero();
    of_h_.add_product(h_N_.data(), x_N_.data());
    A_red_inverse_.add_product(f_N_.data(), x_N_.data());
    scatter(x_N_, N_, x);
  }

  void solve_following(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    auto x_L = x.segment(L_.first, L_.n);
    gather(h, N_, h_N_);
    gather(x, N_, x_N_);
    x_L     = h.segment(L_.first, L_.n) + f.segment(L_.first, L_.n);
    part_N_ = h_N_.head(k_);
    if (is_multiple_)
      part_N_ -= multiple_ * x_N_.head(k_);
    else
      A_LN_.add_product_within(x_N_.data(), x_L.data(), -1.);
    M_LN_.add_product_within(part_N_.data(), x_L.data());
    x_L.array() *= inverse_LL_.array();
  }

private:
  /// A_LN = multiple_ A_LN()
  const PackedMatrix &A_LN() const { return is_multiple_ ? M_LN_ : A_LN_; }
  bool                find_multiple(const MatrixXd &A_LN, const MatrixXd &M_LN)
  {
    constexpr double negligible = 1e-12; // relative: rounding of the sum of two matrices
    const double     square     = M_LN.squaredNorm();
    multiple_                   = square > 0. ? A_LN.cwiseProduct(M_LN).sum() / square : 0.;
    is_multiple_                = (A_LN - multiple_ * M_LN).norm() <= negligible * A_LN.norm();
    if (!is_multiple_)
      multiple_ = 1.;
    return is_multiple_;
  }

  /// f_N += factor A_NL y
  void A_NL_times(const VectorXd &y, double factor) const
  {
    A_LN().add_transposed_product(y.data(), f_N_.data(), factor * multiple_);
  }

  ModalRange       L_;
  std::vector<int> N_;
  VectorXd         inverse_LL_;
  PackedMatrix     M_LN_, A_LN_; ///< A_LN_ is empty where A_LN is a multiple of M_LN
  Eigen::Index     k_;
  double           multiple_    = 1.;
  bool             is_multiple_ = false;
  PackedMatrix     A_red_inverse_, of_h_; ///< A_red^-1 (M_NN - G^T M_LN)
  mutable VectorXd x_N_, h_N_, f_N_;      ///< padded
  mutable VectorXd part_N_, x_L_;
};

} // namespace

std::unique_ptr<LinearSolver> condensed_solver(const CondensedMatrices &matrices, const ModalRange &L,
                                               const std::vector<int> &N)
{
  return std::make_unique<CondensedSolver>(matrices, L, N);
}

} // namespace gestell::coupling
