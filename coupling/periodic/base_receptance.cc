#include "coupling/periodic/response/base_receptance.h"

#include <algorithm>
#include <complex>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;

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

/// (z E - Lambda)^-1 on two rows.
template <typename Rows>
void divide_block(const ModalBlock &block, Complex z, Rows &&x)
{
  if (block.kind == ModalBlock::decaying)
  {
    x.row(0) /= z - block.s;
    x.row(1) /= z - block.w;
  }
  else if (block.kind == ModalBlock::free)
  {
    x.row(1) /= z;
    x.row(0) = (x.row(0) + x.row(1)) / z;
  }
  else
  {
    // det = (z - s)^2 + w^2, by its factors: the nearer one keeps its digits at a resonance
    const Complex             d = z - block.s, det = (d - Complex(0., block.w)) * (d + Complex(0., block.w));
    const Eigen::RowVectorXcd first = (d * x.row(0) - block.w * x.row(1)) / det;
    x.row(1)                        = ((block.w * x.row(0) + d * x.row(1)) / det).eval();
    x.row(0)                        = first;
  }
}

} // namespace

BaseReceptance::BaseReceptance(const LinearSystem &base)
{
  Eigen::MatrixXd M, B, C;
  if (!base.dense_matrices(M, B, C))
    throw std::invalid_argument("frequency response: the base system is sparse and has " + std::to_string(base.size()) +
                                " coordinates; reduce the frame (reduction.method = \"craig-bampton\")");
  const std::vector<int> own  = moving(base);
  const auto            &lags = base.virtual_coordinates();
  const ModalBlocks      modes =
      modal_blocks(M(own, own), B(own, own), C(own, own), [&](int i) { return base.coordinate_name(own[i]); });
  const Eigen::Index n_modal = modes.Q.cols(), n_x = n_modal + Eigen::Index(lags.size());
  blocks_                          = modes.blocks;
  Q_                               = Eigen::MatrixXd::Zero(M.rows(), n_x);
  G_                               = Eigen::MatrixXd::Zero(n_x, M.rows());
  Q_(own, Eigen::seqN(0, n_modal)) = modes.Q;
  G_(Eigen::seqN(0, n_modal), own) = modes.G;
  for (std::size_t i = 0; i < lags.size(); ++i)
  {
    const int lag = lags[i];
    decay_.push_back(-C(lag, lag) / B(lag, lag));
    Q_(lag, n_modal + Eigen::Index(i)) = 1.;
    G_(n_modal + Eigen::Index(i), lag) = 1. / B(lag, lag);
  }
}

void BaseReceptance::divide(double omega, Eigen::MatrixXcd &X) const
{
  const Complex z(0., omega);
  Eigen::Index  row = 0;
  for (const ModalBlock &block : blocks_)
  {
    divide_block(block, z, X.middleRows(row, 2));
    row += 2;
  }
  for (const double decay : decay_)
    X.row(row++) /= z - decay;
}

} // namespace gestell::coupling
