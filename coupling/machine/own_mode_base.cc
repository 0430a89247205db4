#include "coupling/machine/own_mode_base.h"

#include "coupling/machine/condensed_solver.h"

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// With s = D_a^-1 M_a t + R D_b^-1 (h_L + f_L), t = S h_1 - R h_L, and loads M h + f:
///     q_N = A^-1 (f_N + M_NN' h_N + S^T H^-1 s),     eta_b = D_b^-1 (h_L + f_L + R^T H^-1 (S q1 - s)).
class OwnModeSolver final : public LinearSolver
{
public:
  /// @param a,  b  D of the modes, none zero; A_NN, M_NN of everything beside the frame
  OwnModeSolver(const OwnModes &modes, const VectorXd &a, const VectorXd &b, MatrixXd A_NN, const MatrixXd &M_NN,
                std::vector<int> N)
      : R_(modes.R.transpose()), N_(std::move(N)), n1_(int(modes.S.cols())), m_(int(b.size())), S_(modes.S),
        masses_a_(modes.masses.head(a.size()).cwiseQuotient(a)), inverse_b_(b.cwiseInverse())
  {
    const MatrixXd &S = modes.S;
    MatrixXd        H = modes.R * inverse_b_.asDiagonal() * modes.R.transpose();
    H.diagonal() += a.cwiseInverse();
    const MatrixXd H_inverse = symmetric_inverse(H, std::vector<int>(std::size_t(a.size()), 0));
    A_NN.topLeftCorner(n1_, n1_) += S.transpose() * H_inverse * S;
    const MatrixXd A_inverse = symmetric_inverse(A_NN, N_);
    H_inverse_               = PackedMatrix(H_inverse);
    A_inverse_               = PackedMatrix(A_inverse);
    of_s_                    = PackedMatrix(A_inverse.leftCols(n1_) * S.transpose() * H_inverse);
    if (!M_NN.isZero(0.))
      M_NN_ = PackedMatrix(M_NN);
    for (VectorXd *x : {&x_N_, &f_N_})
      x->setZero(PackedMatrix::padded(Index(N_.size())));
    for (VectorXd *x : {&s_, &t_, &l_})
      x->setZero(PackedMatrix::padded(a.size()));
    x_L_.setZero(m_);
  }

  void solve(const VectorXd &f, VectorXd &x) const override
  {
    gather(f, N_, f_N_);
    s_.setZero();
    x_L_ = inverse_b_.cwiseProduct(f.segment(n1_, m_));
    R_.add_transposed_product(x_L_.data(), s_.data());
    solve_N(x);
    auto x_L = x.segment(n1_, m_);
    x_L      = f.segment(n1_, m_);
    finish(x_L);
  }

  const std::vector<int> &leading() const override { return N_; }

  void solve_leading(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    gather(h, N_, x_N_);
    gather(f, N_, f_N_);
    if (!M_NN_.is_empty())
      M_NN_.add_product(x_N_.data(), f_N_.data());
    s_.setZero();
    S_.add_product(x_N_.data(), s_.data());
    R_.add_transposed_product(h.data() + n1_, s_.data(), -1.);
    s_.head(masses_a_.size()).array() *= masses_a_.array();
    x_L_ = inverse_b_.cwiseProduct(h.segment(n1_, m_) + f.segment(n1_, m_));
    R_.add_transposed_product(x_L_.data(), s_.data());
    solve_N(x);
  }

  void solve_following(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    gather(x, N_, x_N_);
    auto x_L = x.segment(n1_, m_);
    x_L      = h.segment(n1_, m_) + f.segment(n1_, m_);
    finish(x_L);
  }

private:
  void solve_N(VectorXd &x) const
  {
    x_N_.setZero();
    A_inverse_.add_product(f_N_.data(), x_N_.data());
    of_s_.add_product(s_.data(), x_N_.data());
    scatter(x_N_, N_, x);
  }

  /// x_L <- D_b^-1 (x_L + R^T H^-1 (S q1 - s)), the final q_N in x_N_
  template <typename Part>
  void finish(Part &x_L) const
  {
    t_ = -s_;
    S_.add_product(x_N_.data(), t_.data());
    l_.setZero();
    H_inverse_.add_product(t_.data(), l_.data());
    R_.add_product_within(l_.data(), x_L.data());
    x_L.array() *= inverse_b_.array();
  }

  PackedMatrix     R_;
  std::vector<int> N_;
  int              n1_, m_;
  PackedMatrix     S_;
  VectorXd         masses_a_, inverse_b_;                ///< D_a^-1 M_a, D_b^-1
  PackedMatrix     H_inverse_, A_inverse_, of_s_, M_NN_; ///< M_NN_ is empty if there is none beside the frame
  mutable VectorXd x_N_, f_N_, s_, t_, l_;               ///< padded; s_ is kept from solve_leading() on
  mutable VectorXd x_L_;
};

/// Rows of a that act: dampers need not.
std::vector<Index> not_zero(const VectorXd &a)
{
  std::vector<Index> which;
  for (Index i = 0; i < a.size(); ++i)
    if (a[i] != 0.)
      which.push_back(i);
  return which;
}

} // namespace

OwnModeBase::OwnModeBase(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C, OwnModes modes,
                         std::unique_ptr<LinearBase> plain)
    : modes_(std::move(modes)), plain_(std::move(plain))
{
  const int n1 = int(modes_.S.cols()), m = int(modes_.R.cols());
  for (int i = 0; i < int(M.rows()); ++i)
    if (i < n1 || i >= n1 + m)
      N_.push_back(i);
  mass_      = blocks_of(M, modes_.masses);
  damping_   = blocks_of(B, modes_.damping);
  stiffness_ = blocks_of(C, modes_.squares);
  for (VectorXd *x : {&x_N_, &y_N_})
    x->setZero(PackedMatrix::padded(Index(N_.size())));
  for (VectorXd *x : {&r_, &t_})
    x->setZero(PackedMatrix::padded(modes_.R.rows()));
}

OwnModeBase::Blocks OwnModeBase::blocks_of(const MatrixXd &A, const VectorXd &values) const
{
  const VectorXd     a      = values.head(modes_.R.rows());
  std::vector<Index> acting = not_zero(a);
  Blocks             blocks{A(N_, N_), {}, {}, {}, a(acting), values.tail(modes_.R.cols())};
  blocks.packed = PackedMatrix(blocks.NN);
  blocks.DS     = PackedMatrix(blocks.a.asDiagonal() * modes_.S(acting, Eigen::all));
  blocks.R      = PackedMatrix(modes_.R(acting, Eigen::all).transpose());
  blocks.NN.topLeftCorner(modes_.S.cols(), modes_.S.cols()) -= modes_.S.transpose() * a.asDiagonal() * modes_.S;
  return blocks;
}

/// y_N = A_NN x_N - S^T D_a R x_L,  y_L = D_b x_L - R^T (D_a S x_1 - D_a R x_L)
void OwnModeBase::multiply(const Blocks &A, const VectorXd &x, VectorXd &y) const
{
  const Index n1 = modes_.S.cols(), m = modes_.R.cols(), n_a = A.a.size();
  gather(x, N_, x_N_);
  r_.setZero();
  A.R.add_transposed_product(x.data() + n1, r_.data(), -1.);
  t_.head(n_a) = A.a.cwiseProduct(r_.head(n_a));
  A.DS.add_product(x_N_.data(), t_.data());
  y_N_.setZero();
  A.packed.add_product(x_N_.data(), y_N_.data());
  A.DS.add_transposed_product(r_.data(), y_N_.data());
  auto y_L = y.segment(n1, m);
  y_L      = A.b.cwiseProduct(x.segment(n1, m));
  A.R.add_product_within(t_.data(), y_L.data(), -1.);
  scatter(y_N_, N_, y);
}

void OwnModeBase::mass_times(const VectorXd &x, VectorXd &y) const
{
  multiply(mass_, x, y);
}

void OwnModeBase::damping_times(const VectorXd &x, VectorXd &y) const
{
  multiply(damping_, x, y);
}

void OwnModeBase::stiffness_times(const VectorXd &x, VectorXd &y) const
{
  multiply(stiffness_, x, y);
}

std::unique_ptr<LinearSolver> OwnModeBase::factorise(double w_M, double w_B, double w_C) const
{
  const VectorXd D = w_M * modes_.masses + w_B * modes_.damping + w_C * modes_.squares, all_a = D.head(modes_.R.rows()),
                 b = D.tail(modes_.R.cols());
  if (!D.allFinite() || !(b.minCoeff() > 0.) || !(all_a.head(modes_.S.cols()).minCoeff() > 0.))
    return plain_->factorise(w_M, w_B, w_C); // rigid-body modes without mass
  const std::vector<Index> acting = not_zero(all_a);
  const OwnModes modes{modes_.S(acting, Eigen::all), modes_.R(acting, Eigen::all), modes_.masses(acting), {}, {}};
  return std::make_unique<OwnModeSolver>(modes, all_a(acting), b,
                                         w_M * mass_.NN + w_B * damping_.NN + w_C * stiffness_.NN, mass_.NN, N_);
}

} // namespace gestell::coupling
