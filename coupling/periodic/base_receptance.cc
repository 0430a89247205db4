#include "coupling/periodic/base_receptance.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// Coordinates with mass: all but the virtual ones, ascending.
std::vector<int> moving(const LinearSystem &base)
{
  const auto      &lags = base.virtual_coordinates();
  std::vector<int> result;
  for (int i = 0; i < base.size(); ++i)
    if (std::find(lags.begin(), lags.end(), i) == lags.end())
      result.push_back(i);
  return result;
}

/// Shares c_1, c_2 of the two products of a block in R(s), and their slopes over s; what is singular at s = 0 is zero.
struct BlockShares
{
  Complex c[2] = {0., 0.}, slope[2] = {0., 0.};
};

BlockShares shares_at(const ModalBlock &block, Complex s)
{
  BlockShares shares;
  if (block.kind == ModalBlock::oscillating)
  {
    // det = (s - sigma)^2 + w^2, by its factors: the nearer one keeps its digits at a resonance
    const Complex a = s - block.s, det = (a - Complex(0., block.w)) * (a + Complex(0., block.w));
    shares.c[0]     = a / det;
    shares.c[1]     = block.w / det;
    shares.slope[0] = (block.w * block.w - a * a) / (det * det);
    shares.slope[1] = -2. * a * block.w / (det * det);
    return shares;
  }
  if (block.kind == ModalBlock::free)
  {
    if (s == 0.)
      return shares;
    shares.c[0]     = 1. / s;
    shares.c[1]     = 1. / (s * s);
    shares.slope[0] = -1. / (s * s);
    shares.slope[1] = -2. / (s * s * s);
    return shares;
  }
  const double eigenvalues[] = {block.s, block.w};
  for (int k = 0; k < 2; ++k)
    if (const Complex a = s - eigenvalues[k]; a != 0.)
    {
      shares.c[k]     = 1. / a;
      shares.slope[k] = -1. / (a * a);
    }
  return shares;
}

/// (s E - Lambda)^-1 on the two rows of a block.
template <typename Rows>
void divide_block(const ModalBlock &block, const Complex (&c)[2], Rows &&x)
{
  if (block.kind == ModalBlock::decaying)
  {
    x.row(0) *= c[0];
    x.row(1) *= c[1];
    return;
  }
  const double sign = block.kind == ModalBlock::free ? 1. : -1.;
  for (Index k = 0; k < x.cols(); ++k)
  {
    const Complex first = x(0, k), second = x(1, k);
    x(0, k) = c[0] * first + sign * c[1] * second;
    x(1, k) = c[0] * second;
    if (block.kind == ModalBlock::oscillating)
      x(1, k) += c[1] * first;
  }
}

/// The two products of read (r_1, r_2) and put (p_1, p_2) that BlockShares weighs.
void products_of(const ModalBlock &block, double r_1, double r_2, double p_1, double p_2, double &first, double &second)
{
  if (block.kind == ModalBlock::oscillating)
  {
    first  = r_1 * p_1 + r_2 * p_2;
    second = r_2 * p_1 - r_1 * p_2;
  }
  else if (block.kind == ModalBlock::free)
  {
    first  = r_1 * p_1 + r_2 * p_2;
    second = r_1 * p_2;
  }
  else
  {
    first  = r_1 * p_1;
    second = r_2 * p_2;
  }
}

} // namespace

BaseReceptance::BaseReceptance(const LinearSystem &base, const MatrixXd &read, const MatrixXd &act)
{
  MatrixXd M, B, C;
  if (!base.dense_matrices(M, B, C))
    throw std::invalid_argument("frequency response: the base system is sparse and has " + std::to_string(base.size()) +
                                " DOFs; reduce the frame (reduction.method = \"craig-bampton\")");
  const std::vector<int> own  = moving(base);
  const auto            &lags = base.virtual_coordinates();
  const ModalBlocks      modes =
      modal_blocks(M(own, own), B(own, own), C(own, own), [&](int i) { return base.coordinate_name(own[i]); });
  const Index n_modal = modes.Q.cols(), n_x = n_modal + 2 * Index(lags.size());
  blocks_                          = modes.blocks;
  Q_                               = MatrixXd::Zero(M.rows(), n_x);
  G_                               = MatrixXd::Zero(n_x, M.rows());
  Q_(own, Eigen::seqN(0, n_modal)) = modes.Q;
  G_(Eigen::seqN(0, n_modal), own) = modes.G;
  for (std::size_t i = 0; i < lags.size(); ++i)
  {
    const int    lag   = lags[i];
    const double decay = -C(lag, lag) / B(lag, lag);
    blocks_.push_back({ModalBlock::decaying, decay, decay});
    Q_(lag, n_modal + 2 * Index(i)) = 1.;
    G_(n_modal + 2 * Index(i), lag) = 1. / B(lag, lag);
  }
  read_ = Q_.transpose() * read;
  put_  = G_ * act;
  fill_products();
}

BaseReceptance::BaseReceptance(const ModalBlocks &modes, const MatrixXd &read, const MatrixXd &act)
    : blocks_(modes.blocks.begin(), modes.blocks.begin() + modes.n_modal), Q_(modes.Q.leftCols(2 * modes.n_modal)),
      G_(modes.G), read_(Q_.transpose() * read), put_(G_ * act)
{
  fill_products();
}

void BaseReceptance::divide(Complex s, Eigen::Ref<MatrixXcd> X) const
{
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    divide_block(blocks_[b], shares_at(blocks_[b], s).c, X.middleRows(2 * Index(b), 2));
}

/// The first products of all blocks, then the second ones.  Those of modes that no damping couples have no first ones.
void BaseReceptance::fill_products()
{
  const Index n_b = Index(blocks_.size()), n_rows = read_.cols(), n_u = put_.cols();
  products_.resize(n_rows * n_u, 2 * n_b);
  for (Index b = 0; b < n_b; ++b)
    for (Index j = 0; j < n_u; ++j)
      for (Index i = 0; i < n_rows; ++i)
        products_of(blocks_[b], read_(2 * b, i), read_(2 * b + 1, i), put_(2 * b, j), put_(2 * b + 1, j),
                    products_(i + n_rows * j, b), products_(i + n_rows * j, n_b + b));
  if (products_.leftCols(n_b).isZero(0.))
    products_ = MatrixXd(products_.rightCols(n_b));
  s_.resize(n_b);
  w_.resize(n_b);
  for (Index b = 0; b < n_b; ++b)
  {
    s_[b] = blocks_[b].s;
    w_[b] = blocks_[b].w;
    if (blocks_[b].kind != ModalBlock::oscillating)
      others_.push_back(int(b));
  }
}

/// Of all blocks at s = i h omega, real and imaginary parts; at once where they oscillate.
void BaseReceptance::fill_shares(int h)
{
  const Index          n_b = w_.size(), rest = products_.cols() - n_b;
  const double         Omega = h * omega_;
  const Eigen::ArrayXd x = s_ * s_ + (w_ - Omega) * (w_ + Omega), y = -2. * Omega * s_;
  const Eigen::ArrayXd inverse = (x * x + y * y).inverse(); // 1/det = (x - i y) inverse
  auto                 real = shares_.col(h), imaginary = shares_.col(harmonics_ + 1 + h);
  if (rest > 0)
  {
    real.head(rest)      = ((Omega * y - s_ * x) * inverse).matrix();
    imaginary.head(rest) = ((Omega * x + s_ * y) * inverse).matrix();
  }
  real.tail(n_b)      = (w_ * x * inverse).matrix();
  imaginary.tail(n_b) = (-w_ * y * inverse).matrix();
  for (const int b : others_)
  {
    const BlockShares shares = shares_at(blocks_[std::size_t(b)], Complex(0., Omega));
    for (int k = rest > 0 ? 0 : 1; k < 2; ++k)
    {
      real[k == 0 ? b : rest + b]      = shares.c[k].real();
      imaginary[k == 0 ? b : rest + b] = shares.c[k].imag();
    }
  }
}

/// d/domega of the shares.
void BaseReceptance::fill_share_slopes(int h)
{
  const Index n_b = w_.size(), rest = products_.cols() - n_b;
  for (Index b = 0; b < n_b; ++b)
  {
    const BlockShares shares = shares_at(blocks_[std::size_t(b)], Complex(0., h * omega_));
    for (int k = rest > 0 ? 0 : 1; k < 2; ++k)
    {
      const Complex slope                    = Complex(0., h) * shares.slope[k];
      const Index   row                      = k == 0 ? b : rest + b;
      shares_(row, 2 * (harmonics_ + 1) + h) = slope.real();
      shares_(row, 3 * (harmonics_ + 1) + h) = slope.imag();
    }
  }
}

void BaseReceptance::tabulate(double omega, int harmonics, Slopes slopes)
{
  omega_        = omega;
  harmonics_    = harmonics;
  const int n_h = harmonics + 1;
  shares_.resize(products_.cols(), (slopes == Slopes::with ? 4 : 2) * n_h);
  for (int h = 0; h < n_h; ++h)
  {
    fill_shares(h);
    if (slopes == Slopes::with)
      fill_share_slopes(h);
  }
  table_.noalias() = products_ * shares_.leftCols(2 * n_h);
  if (slopes == Slopes::with)
    slope_.noalias() = products_ * shares_.rightCols(2 * n_h);
}

MatrixXcd BaseReceptance::entry(const MatrixXd &table, int h) const
{
  const Index n_rows = read_.cols(), n_u = put_.cols();
  MatrixXcd   R(n_rows, n_u);
  R.real() = Eigen::Map<const MatrixXd>(table.col(h).data(), n_rows, n_u);
  R.imag() = Eigen::Map<const MatrixXd>(table.col(harmonics_ + 1 + h).data(), n_rows, n_u);
  return R;
}

} // namespace gestell::coupling
