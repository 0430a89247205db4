#pragma once

#include "coupling/reduction/reduce_frame.h"

namespace gestell::test
{

/// To be reduced with the lowest n fixed-interface modes.
inline coupling::ReductionOptions with_modes(int n)
{
  coupling::ReductionOptions options;
  options.n_modes = n;
  return options;
}

/// T of Craig and Bampton with the lowest m fixed-interface modes.
inline coupling::ReductionBasis basis_with_modes(const fem::FrameMatrices &frame, int m)
{
  return coupling::reduce_with_basis(frame, with_modes(m)).basis;
}

} // namespace gestell::test
