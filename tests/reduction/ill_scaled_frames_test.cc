// Frames with very soft and very stiff parts, near what rounding leaves of them.

#include "coupling/dense_modes.h"
#include "coupling/integration/second_order_system.h"
#include "coupling/reduction/counted_modes.h"
#include "coupling/reduction/craig_bampton.h"
#include "lattice.h"

#include <gtest/gtest.h>

#include <limits>

namespace gestell::test
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Blocks of 3 x 3 x nz points one above the other, a gap between them.
fem::FrameMatrices two_blocks(const Lattice &whole, Eigen::SparseMatrix<double> &between, double soft)
{
  Lattice lower                             = whole;
  lower.nz                                  = whole.nz / 2;
  const auto                          half  = frame_of(lower);
  auto                                frame = frame_of(whole); // masses, motions
  const int                           n     = int(half.C.rows());
  std::vector<Eigen::Triplet<double>> rods, weak;
  for (int j = 0; j < n; ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator c(half.C, j); c; ++c)
      for (const int at : {0, n})
        rods.emplace_back(at + int(c.row()), at + j, c.value());
  Lattice weaker   = whole;
  weaker.stiffness = soft;
  for (int p = 0; p < whole.nx * whole.ny; ++p)
    for (int r = 0; r < whole.nx * whole.ny; ++r)
      add_rod(weak, weaker, n / 3 - whole.nx * whole.ny + p, n / 3 + r);
  between.resize(2 * n, 2 * n);
  between.setFromTriplets(weak.begin(), weak.end());
  frame.C.setFromTriplets(rods.begin(), rods.end());
  frame.C += between;
  frame.C.makeCompressed();
  frame.interfaces.clear();
  for (const int k : {0, whole.nz - 1}) // each block is held by four points
    for (const int i : {0, 2})
      frame.interfaces.push_back(
          interface_at("i" + std::to_string(k) + std::to_string(i), whole.point(i, 0, k), whole.point(i, 2, k)));
  return frame;
}

TEST(FloatingFrame, CountsItsOwnMotionsWhereSoftOnesAreHardlyMoreThanRounding)
{
  Lattice lattice;
  lattice.nx = 3, lattice.ny = 3, lattice.nz = 8;
  lattice.foundation = lattice.damper = 0.;
  for (const double soft : {1e-1, 1e-4}) // of 1e7; S scaled to unit diagonal has eigenvalues of 1e-9 and 1e-12
  {
    Eigen::SparseMatrix<double> between;
    const auto                  frame = two_blocks(lattice, between, soft);
    const int                   n     = int(frame.C.rows());
    MatrixXd                    R     = MatrixXd::Zero(n, 12); // blocks that move as rigid bodies: 1e-8 too stiff
    R.topLeftCorner(n / 2, 6)         = frame.rigid_motions.topRows(n / 2);
    R.bottomRightCorner(n / 2, 6)     = frame.rigid_motions.bottomRows(n / 2);
    const VectorXd bodies =
        coupling::dense_modes(R.transpose() * (between * R), R.transpose() * (frame.M * R), 1e-12, 6).omega;
    coupling::ReductionOptions options;
    options.n_modes    = 10;
    const auto reduced = coupling::craig_bampton(frame, options);
    EXPECT_EQ((reduced.frequencies_hz.array() == 0.).count(), 6) << soft;
    EXPECT_EQ(reduced.facts.free_motions.size(), 6u);
    for (int j = 6; j < 12; ++j) // rounding of C*, 1e-16 of 1e9, beside 1e-4
    {
      EXPECT_NEAR(reduced.frequencies_hz[j] * 2. * M_PI, bodies[j], 1e-2 * bodies[j]) << soft << " " << j;
      EXPECT_LT(reduced.frequency_error[j], 1e-2);
    }
  }
}

} // namespace
} // namespace gestell::test
