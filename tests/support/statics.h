#pragma once

#include "fem/values/frame_matrices.h"

#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace gestell::test
{

/// Static displacement  q = C^-1 f  of a held frame.
inline Eigen::VectorXd statics(const fem::FrameMatrices &frame, const Eigen::VectorXd &force)
{
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(frame.C);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("the frame of the test is not held");
  return factor.solve(force);
}

} // namespace gestell::test
