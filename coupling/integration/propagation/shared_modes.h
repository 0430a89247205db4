#pragma once

#include "coupling/integration/propagation/modal_blocks.h"

namespace gestell::coupling
{

/// The modes of the matrices that were asked for last: systems of a family, whose forces and loads differ but whose
/// matrices do not, share them.
class SharedModes
{
public:
  /// As modal_blocks(M, B, C, coordinate_name), found anew where a matrix differs in any digit.
  const ModalBlocks &of(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B, const Eigen::MatrixXd &C,
                        const std::function<std::string(int)> &coordinate_name);
  int                found() const { return found_; } ///< how often

private:
  Eigen::MatrixXd M_, B_, C_;
  ModalBlocks     blocks_;
  int             found_ = 0;
};

} // namespace gestell::coupling
