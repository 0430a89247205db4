#include "coupling/machine/own_modes.h"

#include "coupling/algebra/dense_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Whether A has no entries beside its diagonal, up to the rounding of modes.
bool decouples(const MatrixXd &A)
{
  constexpr double rounding = 1e-10;
  const VectorXd   scale    = A.diagonal().cwiseAbs().cwiseSqrt();
  const MatrixXd   rest     = A - MatrixXd(A.diagonal().asDiagonal());
  return (rest.array().abs() <= rounding * (scale * scale.transpose()).array()).all();
}

/// The same modes with signs that depend on their shape at the interface V_1 alone.
void fix_signs(MatrixXd &V, Index n1)
{
  for (Index j = 0; j < V.cols(); ++j)
  {
    Index largest = 0;
    V.col(j).head(n1).cwiseAbs().maxCoeff(&largest);
    if (V(largest, j) < 0.)
      V.col(j) = -V.col(j);
  }
}

/// Modes a that move q1 independently, the lowest where there is a choice: forces are then small differences. Weights
/// are flexibilities.
std::vector<Index> modes_of_interface(const MatrixXd &V_1, const VectorXd &omega)
{
  const double low     = omega.maxCoeff() * 1e-3; // rigid-body modes come first, but not infinitely so
  MatrixXd     weighed = V_1 * (omega.array() + low).inverse().matrix().asDiagonal();
  weighed.rowwise().normalize();
  const auto         order = weighed.colPivHouseholderQr().colsPermutation().indices();
  std::vector<Index> first(order.data(), order.data() + V_1.rows());
  std::sort(first.begin(), first.end());
  return first;
}

void turn_rows(ReducedFrame &frame, const MatrixXd &X)
{
  const Index n = X.rows();
  for (MatrixXd *A : {&frame.M, &frame.B, &frame.C})
  {
    *A = (X.transpose() * *A * X).eval();
    *A = (0.5 * (*A + A->transpose())).eval();
  }
  frame.translations_load = (X.transpose() * frame.translations_load).eval();
  for (fem::FrameOutput &output : frame.outputs)
    for (VectorXd *row : {&output.on_q, &output.on_v, &output.on_a})
      if (row->size() > 0)
        *row = (X.transpose() * *row).eval();
  const Eigen::MatrixXf single = X.cast<float>();
  if (frame.displacement.rows() > 0)
    frame.displacement = (frame.displacement * single).eval();
  for (Eigen::MatrixXf *stress : {&frame.stress.mean, &frame.stress.deviation})
    if (stress->rows() > 0)
      stress->leftCols(n) = (stress->leftCols(n) * single).eval();
}

} // namespace

std::optional<OwnModes> turn_to_own_modes(ReducedFrame &frame)
{
  constexpr Index many = 64; // fixed-interface modes: for fewer, one product with the stored inverse is as fast
  const Index     n = frame.M.rows(), n1 = frame.n_interface, m = n - n1;
  if (!frame.modal || n1 == 0 || m < many || decouples(frame.B.bottomRightCorner(m, m)))
    return {};
  DenseModes own = dense_modes(frame.C, frame.M, cancelled_by_reduction, frame.n_rigid());
  if (own.omega.size() < n || !decouples(own.V.transpose() * frame.B * own.V))
    return {};
  fix_signs(own.V, n1);
  const std::vector<Index> a     = modes_of_interface(own.V.topRows(n1), own.omega);
  std::vector<Index>       order = a;
  for (Index j = 0; j < n; ++j)
    if (!std::binary_search(a.begin(), a.end(), j))
      order.push_back(j);
  const MatrixXd V = own.V(Eigen::all, order);

  OwnModes modes;
  modes.S       = V.topLeftCorner(n1, n1).inverse();
  modes.R       = modes.S * V.topRightCorner(n1, m);
  modes.squares = VectorXd(own.omega.cwiseAbs2())(order);
  modes.damping = (V.transpose() * frame.B * V).diagonal();
  MatrixXd X(n, n);
  X.leftCols(n1) = V.leftCols(n1) * modes.S;
  X.rightCols(m) = V.rightCols(m) - V.leftCols(n1) * modes.R;
  X.topRows(n1)  = MatrixXd::Identity(n1, n);
  turn_rows(frame, X);
  return modes;
}

namespace
{

/// With s = D_a^-1 t + R D_b^-1 (h_L + f_L), t = S h_1 - R h_L, and loads M h + f:
///     q_N = A^-1 (f_N + M_NN' h_N + S^T H^-1 s),     eta_b = D_b^-1 (h_L + f_L + R^T H^-1 (S q1 - s)).
class OwnModeSolver final : public LinearSolver
{
public:
  /// @param a,  b  D of the modes; A_NN, M_NN of everything beside the frame
  OwnModeSolver(const OwnModes &modes, const PackedMatrix &R, const VectorXd &a, const VectorXd &b, MatrixXd A_NN,
                const MatrixXd &M_NN, std::vector<int> N)
      : R_(R), N_(std::move(N)), L_(int(modes.S.rows())), m_(int(b.size())), S_(modes.S), inverse_a_(a.cwiseInverse()),
        inverse_b_(b.cwiseInverse())
  {
    const MatrixXd &S = modes.S;
    MatrixXd        H = modes.R * inverse_b_.asDiagonal() * modes.R.transpose();
    H.diagonal() += inverse_a_;
    const MatrixXd H_inverse = symmetric_inverse(H, N_);
    A_NN.topLeftCorner(L_, L_) += S.transpose() * H_inverse * S;
    const MatrixXd A_inverse = symmetric_inverse(A_NN, N_);
    H_inverse_               = PackedMatrix(H_inverse);
    A_inverse_               = PackedMatrix(A_inverse);
    of_s_                    = PackedMatrix(A_inverse.leftCols(L_) * S.transpose() * H_inverse);
    if (!M_NN.isZero(0.))
      M_NN_ = PackedMatrix(M_NN);
    for (VectorXd *x : {&x_N_, &f_N_})
      x->setZero(PackedMatrix::padded(Index(N_.size())));
    for (VectorXd *x : {&s_, &t_, &l_})
      x->setZero(PackedMatrix::padded(L_));
    x_L_.setZero(m_);
  }

  void solve(const VectorXd &f, VectorXd &x) const override
  {
    gather(f, N_, f_N_);
    s_.setZero();
    x_L_ = inverse_b_.cwiseProduct(f.segment(L_, m_));
    R_.add_transposed_product(x_L_.data(), s_.data());
    solve_N(x);
    auto x_L = x.segment(L_, m_);
    x_L      = f.segment(L_, m_);
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
    R_.add_transposed_product(h.data() + L_, s_.data(), -1.);
    s_.head(L_).array() *= inverse_a_.array();
    x_L_ = inverse_b_.cwiseProduct(h.segment(L_, m_) + f.segment(L_, m_));
    R_.add_transposed_product(x_L_.data(), s_.data());
    solve_N(x);
  }

  void solve_following(const VectorXd &h, const VectorXd &f, VectorXd &x) const override
  {
    gather(x, N_, x_N_);
    auto x_L = x.segment(L_, m_);
    x_L      = h.segment(L_, m_) + f.segment(L_, m_);
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
  int              L_, m_;
  PackedMatrix     S_;
  VectorXd         inverse_a_, inverse_b_;
  PackedMatrix     H_inverse_, A_inverse_, of_s_, M_NN_; ///< M_NN_ is empty if there is none beside the frame
  mutable VectorXd x_N_, f_N_, s_, t_, l_;               ///< padded; s_ is kept from solve_leading() on
  mutable VectorXd x_L_;
};

} // namespace

OwnModeBase::OwnModeBase(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C, OwnModes modes)
    : DenseBase(M, B, C), modes_(std::move(modes)), R_(modes_.R.transpose())
{
  const int n1 = int(modes_.R.rows()), m = int(modes_.R.cols());
  for (int i = 0; i < int(M.rows()); ++i)
    if (i < n1 || i >= n1 + m)
      N_.push_back(i);
  mass_      = blocks_of(M, VectorXd::Ones(n1 + m));
  damping_   = blocks_of(B, modes_.damping);
  stiffness_ = blocks_of(C, modes_.squares);
  for (VectorXd *x : {&x_N_, &y_N_})
    x->setZero(PackedMatrix::padded(Index(N_.size())));
  for (VectorXd *x : {&r_, &t_})
    x->setZero(PackedMatrix::padded(n1));
}

OwnModeBase::Blocks OwnModeBase::blocks_of(const MatrixXd &A, const VectorXd &values) const
{
  const Index n1 = modes_.R.rows(), m = modes_.R.cols();
  Blocks      blocks{A(N_, N_), {}, {}, values.head(n1), values.tail(m)};
  blocks.packed = PackedMatrix(blocks.NN);
  blocks.DS     = PackedMatrix(blocks.a.asDiagonal() * modes_.S);
  return blocks;
}

/// y_N = A_NN x_N - S^T D_a R x_L,  y_L = D_b x_L - R^T (D_a S x_1 - D_a R x_L)
void OwnModeBase::multiply(const Blocks &A, const VectorXd &x, VectorXd &y) const
{
  const Index n1 = modes_.R.rows(), m = modes_.R.cols();
  gather(x, N_, x_N_);
  r_.setZero();
  R_.add_transposed_product(x.data() + n1, r_.data(), -1.);
  t_.head(n1) = A.a.cwiseProduct(r_.head(n1));
  A.DS.add_product(x_N_.data(), t_.data());
  y_N_.setZero();
  A.packed.add_product(x_N_.data(), y_N_.data());
  A.DS.add_transposed_product(r_.data(), y_N_.data());
  auto y_L = y.segment(n1, m);
  y_L      = A.b.cwiseProduct(x.segment(n1, m));
  R_.add_product_within(t_.data(), y_L.data(), -1.);
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
  const VectorXd a = w_M * mass_.a + w_B * damping_.a + w_C * stiffness_.a,
                 b = w_M * mass_.b + w_B * damping_.b + w_C * stiffness_.b;
  if (!a.allFinite() || !b.allFinite() || !(a.minCoeff() > 0.) || !(b.minCoeff() > 0.))
    return DenseBase::factorise(w_M, w_B, w_C); // rigid-body modes without mass
  const auto beside = [&](const Blocks &A)
  {
    MatrixXd rest = A.NN;
    rest.topLeftCorner(a.size(), a.size()) -= modes_.S.transpose() * A.a.asDiagonal() * modes_.S;
    return rest;
  };
  const MatrixXd M_NN = beside(mass_);
  return std::make_unique<OwnModeSolver>(modes_, R_, a, b,
                                         w_M * M_NN + w_B * beside(damping_) + w_C * beside(stiffness_), M_NN, N_);
}

} // namespace gestell::coupling
