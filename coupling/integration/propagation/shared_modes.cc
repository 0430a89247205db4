#include "coupling/integration/propagation/shared_modes.h"

namespace gestell::coupling
{

namespace
{
bool same_matrix(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}
} // namespace

const ModalBlocks &SharedModes::of(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
                                   const std::function<std::string(int)> &coordinate_name)
{
  if (found_ > 0 && same_matrix(M, M_) && same_matrix(B, B_) && same_matrix(C, C_))
    return blocks_;
  blocks_ = modal_blocks(M, B, C, coordinate_name);
  M_      = M;
  B_      = B;
  C_      = C;
  ++found_;
  return blocks_;
}

} // namespace gestell::coupling
