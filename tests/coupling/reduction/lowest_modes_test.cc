#include "coupling/eigensolvers/block_lanczos.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/reduction/shapes/fixed_interface_modes.h"
#include "tests/support/cube.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using coupling::BlockLanczos;
using coupling::FixedInterfaceModes;
using coupling::LowestModes;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

struct Structure
{
  SparseMatrix             C, M;
  coupling::SparseCholesky factor{C};

  std::unique_ptr<coupling::InverseStiffness> inverse() const
  {
    return std::make_unique<coupling::InverseByFactor>(factor);
  }
};

Structure cube(int n)
{
  return {test::cube_stiffness(n), test::unit_mass(n * n * n)};
}

/// Masses of very different size, so that M matters.
Structure lattice()
{
  auto frame = test::frame_of(test::Lattice{});
  for (int i = 0; i < frame.M.rows(); ++i)
    frame.M.coeffRef(i, i) *= 1. + i % 7;
  return {frame.C, frame.M};
}

BlockLanczos::Options blocks_of(int size)
{
  BlockLanczos::Options options;
  options.block = size;
  return options;
}

TEST(BlockLanczos, ModesAreOrthonormalAndFrequenciesWithinTheirBounds)
{
  const Structure s     = lattice();
  const auto      exact = coupling::dense_modes(MatrixXd(s.C), MatrixXd(s.M));
  for (const double tolerance : {1e-2, 1e-4, 1e-8})
  {
    auto options      = blocks_of(4);
    options.tolerance = tolerance;
    BlockLanczos search(s.M, s.inverse(), options);
    search.find(20);
    const LowestModes found = search.modes(20);
    EXPECT_LT((found.V.transpose() * s.M * found.V - MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-12);
    for (int j = 0; j < 20; ++j)
    {
      EXPECT_LE(found.bound(j), 0.51 * tolerance / (1. - tolerance));
      EXPECT_LE((exact.omega.array() - found.omega(j)).abs().minCoeff(), (found.bound(j) + 1e-13) * found.omega(j));
      // from above, and by no more than the square of the residual over the distance to the others
      EXPECT_GE(found.omega(j), exact.omega(j) * (1. - 1e-12));
    }
  }
}

TEST(BlockLanczos, ResidualsAreWhatTheBoundsTell)
{
  const Structure s       = lattice();
  auto            options = blocks_of(5);
  options.tolerance       = 1e-3;
  BlockLanczos search(s.M, s.inverse(), options);
  search.find(12);
  const LowestModes found = search.modes(12);
  for (int j = 0; j < 12; ++j)
  {
    MatrixXd     r     = s.M * found.V.col(j);
    const double theta = 1. / (found.omega(j) * found.omega(j));
    s.factor.solve_in_place(r);
    r -= theta * found.V.col(j);
    const double share = std::sqrt((r.transpose() * s.M * r).value()) / theta;
    EXPECT_NEAR(0.5 * share / (1. - share), found.bound(j), 1e-3 * found.bound(j) + 1e-12);
  }
}

using BlockSize = ::testing::TestWithParam<int>;

TEST_P(BlockSize, AllRepeatedFrequenciesOfACubeAreFound)
{
  const Structure s     = cube(9);
  const auto      exact = test::cube_frequencies(9);
  BlockLanczos    search(s.M, s.inverse(), blocks_of(GetParam()));
  search.find(60);
  const VectorXd found = search.modes(60).omega;
  for (int j = 0; j < 60; ++j)
    EXPECT_NEAR(found(j), exact[j], 1e-10 * exact[j]) << j;
}
INSTANTIATE_TEST_SUITE_P(AtLeastAsLargeAsTheMultiplicity, BlockSize, ::testing::Values(6, 12, 25));

TEST(BlockLanczos, RestartedFromItsBestVectorsFindsTheSame)
{
  const Structure s       = cube(9);
  const auto      exact   = test::cube_frequencies(9);
  auto            options = blocks_of(6);
  options.room            = 50;
  BlockLanczos search(s.M, s.inverse(), options);
  search.find(20);
  EXPECT_LE(search.n_vectors(), 50);
  const LowestModes found = search.modes(20);
  for (int j = 0; j < 20; ++j)
    EXPECT_NEAR(found.omega(j), exact[j], 1e-10 * exact[j]) << j;
  EXPECT_LT((found.V.transpose() * found.V - MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BlockLanczos, GoesOnToAGapAndReportsWhatLiesBelow)
{
  const Structure s     = cube(6);
  const auto      exact = test::cube_frequencies(6); // 1, 3, 3, 1 + 6 ... times
  BlockLanczos    search(s.M, s.inverse(), blocks_of(8));
  search.find(2); // in the midst of a triple
  const auto gap = search.gap_above(2);
  EXPECT_EQ(gap.below, 4);
  EXPECT_NEAR(gap.low, exact[3], 1e-6);
  EXPECT_NEAR(gap.high, exact[4], 1e-2);
}

TEST(BlockLanczos, UsesUpAllCoordinatesThereAre)
{
  const Structure s     = cube(3); // 27, with six-fold frequencies: blocks break down
  const auto      exact = test::cube_frequencies(3);
  for (const int block : {1, 4, 12, 40})
  {
    BlockLanczos search(s.M, s.inverse(), blocks_of(block));
    search.find(27);
    const LowestModes found = search.modes(27);
    for (int j = 0; j < 27; ++j)
      EXPECT_NEAR(found.omega(j), exact[j], 1e-10) << block;
    EXPECT_LT((found.V.transpose() * found.V - MatrixXd::Identity(27, 27)).cwiseAbs().maxCoeff(), 1e-10) << block;
    EXPECT_EQ(search.gap_above(27).below, 27);
    EXPECT_TRUE(std::isinf(search.gap_above(27).high));
    EXPECT_THROW(search.find(28), coupling::ConvergenceFailure);
  }
}

TEST(BlockLanczos, CoordinatesWithoutMassHaveNoModes)
{
  Structure s = cube(4);
  for (int i = 10; i < 64; ++i)
    s.M.coeffRef(i, i) = 0.;
  const auto   exact = coupling::dense_modes(MatrixXd(s.C), MatrixXd(s.M));
  BlockLanczos search(s.M, s.inverse(), blocks_of(4));
  search.find(10);
  EXPECT_LT((search.modes(10).omega - exact.omega.head(10)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_THROW(search.find(11), coupling::ConvergenceFailure);
}

TEST(BlockLanczos, OfNoModesIsEmpty)
{
  const Structure s = cube(4);
  BlockLanczos    search(s.M, s.inverse(), {});
  search.find(0);
  EXPECT_EQ(search.modes(0).V.cols(), 0);
  EXPECT_EQ(search.modes(0).V.rows(), 64);
  EXPECT_THROW(BlockLanczos(s.M, s.inverse(), blocks_of(0)), std::invalid_argument);
}

fem::FrameMatrices cube_frame()
{
  fem::FrameMatrices frame;
  frame.C = test::cube_stiffness(9);
  frame.M = test::unit_mass(729);
  return frame;
}

/// Single vectors pass over repeated frequencies; the inertia tells.
TEST(FixedInterfaceModes, SkippedAreCountedSearchedForAndFound)
{
  const auto frame   = cube_frame();
  const auto exact   = test::cube_frequencies(9);
  const auto largest = [&](const VectorXd &omega)
  {
    double error = 0.;
    for (int j = 0; j < 20; ++j)
      error = std::max(error, std::abs(omega(j) / exact[j] - 1.));
    return error;
  };
  for (const bool forgotten : {false, true})
  {
    coupling::FixedInterfaceFrame held(frame, {});
    FixedInterfaceModes           modes(held, frame, {}, blocks_of(1));
    modes.find(20);
    modes.finish();
    EXPECT_GT(largest(modes.found().omega), 1e-3);
    if (forgotten)
      modes.forget_shapes();
    EXPECT_FALSE(modes.confirm());
    modes.find(20);
    EXPECT_LT(largest(modes.lowest(20).omega), 1e-10);
    modes.finish();
    EXPECT_TRUE(modes.confirm());
    EXPECT_NE(modes.statement().find("missing at first"), std::string::npos) << modes.statement();
  }
}

TEST(FixedInterfaceModes, AreAllFoundInOneCall)
{
  const auto frame = cube_frame();
  const auto exact = test::cube_frequencies(9);

  coupling::FixedInterfaceFrame held(frame, {});
  const LowestModes             modes = FixedInterfaceModes(held, frame, {}, blocks_of(1)).find_all(20);
  ASSERT_EQ(modes.omega.size(), 20);
  ASSERT_EQ(modes.V.cols(), 20);
  for (int j = 0; j < 20; ++j)
    EXPECT_NEAR(modes.omega(j), exact[j], 1e-10 * exact[j]) << j;
}

TEST(FixedInterfaceModes, AllFoundAreConfirmedAtOnce)
{
  const auto                    frame = cube_frame();
  coupling::FixedInterfaceFrame held(frame, {});
  FixedInterfaceModes           modes(held, frame, {});
  modes.find(20);
  modes.finish();
  EXPECT_TRUE(modes.confirm());
  EXPECT_NE(modes.statement().find("20 fixed-interface modes below it, and all of them are found"), std::string::npos)
      << modes.statement();
}

} // namespace
} // namespace gestell
