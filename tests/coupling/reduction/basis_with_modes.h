#pragma once

#include "coupling/reduction/reduce_frame.h"

namespace gestell::test
{

/// T of Craig and Bampton with the lowest m fixed-interface modes.
inline coupling::ReductionBasis basis_with_modes(const fem::FrameMatrices &frame, int m)
{
  coupling::ReductionOptions options;
  options.n_modes = m;
  return coupling::reduce_with_basis(frame, options).basis;
}

} // namespace gestell::test
