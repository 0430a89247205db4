#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/reduce_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"

#include <gtest/gtest.h>

namespace gestell
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::frame_of;
using test::Lattice;

/// 1200 coordinates: too many for the dense way, so that block Lanczos does the work.
fem::FrameMatrices large_frame()
{
  Lattice lattice;
  lattice.nx = 10, lattice.ny = 4, lattice.nz = 10;
  return frame_of(lattice);
}

TEST(FixedInterfaceModes, AreOrthonormalAndZeroOnTheInterface)
{
  const auto     frame = large_frame();
  const auto     basis = test::basis_with_modes(frame, 30);
  const MatrixXd V     = basis.fixed_modes();
  EXPECT_LT((V.transpose() * frame.M * V - MatrixXd::Identity(30, 30)).cwiseAbs().maxCoeff(), 1e-9);
  const MatrixXd C = V.transpose() * frame.C * V;
  EXPECT_LT((C - MatrixXd(basis.omega0.cwiseAbs2().asDiagonal())).cwiseAbs().maxCoeff(),
            1e-7 * basis.omega0.cwiseAbs2().maxCoeff());
  EXPECT_EQ(V(basis.q1, Eigen::all).cwiseAbs().maxCoeff(), 0.);
}

TEST(FixedInterfaceModes, FoundInTwoBatchesAreThoseFoundInOne)
{
  const auto                 frame   = large_frame();
  const auto                 at_once = test::basis_with_modes(frame, 45);
  coupling::ReductionOptions options;
  options.tolerance  = 1e-4; // needs more than the first thirty
  const auto reduced = reduce_frame(frame, options);
  const int  m       = std::min<int>(45, reduced.omega0.size());
  ASSERT_GT(m, 30);
  for (int j = 0; j < m; ++j)
    EXPECT_NEAR(reduced.omega0(j) / at_once.omega0(j), 1., 1e-9);
}

TEST(RefinedModes, OfALargeFrameAreThoseOfTheDenseMatrices)
{
  auto       frame          = large_frame();
  const auto exact          = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M));
  frame.modal_damping_ratio = 0.5; // then d = omega
  coupling::add_modal_damping(frame, 10);
  for (int j = 0; j < 10; ++j)
    EXPECT_NEAR(frame.modal_damping.d(j) / exact.omega(j), 1., 1e-8);
}

} // namespace
} // namespace gestell
