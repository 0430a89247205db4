#pragma once

#include "fem/values/frame_matrices.h"

#include <Eigen/Core>

namespace gestell::test
{

/// Lowest modes (C - omega^2 M) v = 0 of a held frame: v^T M v = 1, frequencies ascending.
struct Modes
{
  Eigen::VectorXd frequency_hz;
  Eigen::MatrixXd shape;
};

/// Inverse iteration of a subspace, until no frequency changes by more than 1e-12 of itself.
Modes lowest_modes(const fem::FrameMatrices &frame, int n_modes);

} // namespace gestell::test
