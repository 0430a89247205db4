#include "coupling/algebra/sparse_cholesky.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/algebra/node_ordering.h"
#include "tests/support/cube.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>

namespace gestell
{
namespace
{

using coupling::SparseCholesky;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Several hundred coordinates, three to a point.
fem::FrameMatrices block()
{
  test::Lattice lattice;
  lattice.nx = 7, lattice.ny = 5, lattice.nz = 8;
  return test::frame_of(lattice);
}

MatrixXd irregular(Eigen::Index rows, Eigen::Index columns)
{
  return MatrixXd::NullaryExpr(rows, columns,
                               [](Eigen::Index i, Eigen::Index j) { return std::sin(1. + i * 1.7 + j); });
}

TEST(SparseCholesky, SolvesAsADenseFactorDoes)
{
  const auto           frame = block();
  const MatrixXd       dense = frame.C, F = irregular(dense.rows(), 40);
  const SparseCholesky factor(frame.C);
  MatrixXd             X = F;
  factor.solve_in_place(X);
  const MatrixXd exact = dense.llt().solve(F);
  EXPECT_LT((X - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
  for (const int columns : {2, 7, 11, 16, 18, 24, 25}) // those of every kernel, and some left over
  {
    MatrixXd some = F.leftCols(columns);
    factor.solve_in_place(some);
    EXPECT_LT((some - X.leftCols(columns)).cwiseAbs().maxCoeff(), 1e-14 * exact.cwiseAbs().maxCoeff()) << columns;
  }
  VectorXd x(dense.rows());
  factor.solve(F.col(3).data(), x.data());
  EXPECT_LT((x - X.col(3)).cwiseAbs().maxCoeff(), 1e-14 * exact.cwiseAbs().maxCoeff());
}

TEST(SparseCholesky, ReadsTheLowerTriangleAlone)
{
  const auto                        frame = block();
  const Eigen::SparseMatrix<double> lower = frame.C.triangularView<Eigen::Lower>();
  MatrixXd                          X = irregular(lower.rows(), 1), Y = X;
  SparseCholesky(lower).solve_in_place(X);
  SparseCholesky(frame.C).solve_in_place(Y);
  EXPECT_EQ((X - Y).cwiseAbs().maxCoeff(), 0.);
}

TEST(SparseCholesky, HeldCoordinatesAreCutOff)
{
  const auto             frame = block();
  const std::vector<int> held{0, 5, 6, 100, 333};
  std::vector<int>       others;
  for (int i = 0; i < frame.C.rows(); ++i)
    if (!std::binary_search(held.begin(), held.end(), i))
      others.push_back(i);
  MatrixXd F = irregular(frame.C.rows(), 2);
  F(held, Eigen::all).setZero();
  MatrixXd X = F;
  SparseCholesky(frame.C, held).solve_in_place(X);
  const MatrixXd C = frame.C, inner = C(others, others), f = F(others, Eigen::all), exact = inner.llt().solve(f);
  EXPECT_LT((X(others, Eigen::all) - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
  EXPECT_EQ(X(held, Eigen::all).cwiseAbs().maxCoeff(), 0.);
}

TEST(SparseCholesky, NamesTheCoordinateThatHasNoStiffness)
{
  auto frame = block();
  for (Eigen::SparseMatrix<double>::InnerIterator c(frame.C, 77); c; ++c)
    frame.C.coeffRef(77, c.row()) = frame.C.coeffRef(c.row(), 77) = 0.;
  try
  {
    SparseCholesky factor(frame.C);
    FAIL();
  }
  catch (const coupling::NotPositiveDefinite &failure)
  {
    EXPECT_EQ(failure.row, 77);
  }
}

TEST(SparseCholesky, ThatWouldNotFitIsRefusedWithWhatItNeeds)
{
  const auto   frame  = block();
  const double needed = 8. * SparseCholesky(frame.C).entries(); // and work beside it
  EXPECT_NO_THROW(SparseCholesky(frame.C, {}, 100. * needed));
  try
  {
    SparseCholesky factor(frame.C, {}, needed);
    FAIL();
  }
  catch (const coupling::NotEnoughMemory &failure)
  {
    EXPECT_NE(std::string(failure.what()).find("GiB are available; use a coarser mesh"), std::string::npos)
        << failure.what();
  }
}

TEST(Inertia, IsTheNumberOfFrequenciesBelow)
{
  const auto frame = block();
  const auto exact = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M));
  const auto n     = exact.omega.size();
  ASSERT_EQ(n, frame.C.rows());
  SparseCholesky factor(frame.C);
  factor.release();
  for (const Eigen::Index below : {0, 1, 2, 7, 40, 200, 501, int(n) - 1, int(n)})
  {
    const double low = below > 0 ? exact.omega(below - 1) : 0., high = below < n ? exact.omega(below) : 2. * low;
    const double sigma = 0.5 * (low * low + high * high);
    const auto   found = factor.inertia(frame.C, frame.M, sigma);
    EXPECT_EQ(found.negative, below);
    EXPECT_LT(found.growth, 1e9);
    EXPECT_GE(found.growth, 1.);
  }
}

TEST(Inertia, CountsRepeatedFrequenciesAsOftenAsTheyAre)
{
  const auto           C = test::cube_stiffness(8), M = test::unit_mass(512);
  const auto           omega = test::cube_frequencies(8);
  const SparseCholesky factor(C);
  for (int below = 1; below < 100; ++below)
    if (omega[below] > omega[below - 1] * 1.0001)
    {
      EXPECT_EQ(
          factor.inertia(C, M, 0.5 * (omega[below] * omega[below] + omega[below - 1] * omega[below - 1])).negative,
          below);
    }
}

TEST(Inertia, LeavesHeldCoordinatesOut)
{
  const auto             frame = block();
  const std::vector<int> held{3, 4, 5, 300};
  std::vector<int>       others;
  for (int i = 0; i < frame.C.rows(); ++i)
    if (!std::binary_search(held.begin(), held.end(), i))
      others.push_back(i);
  const MatrixXd       C = frame.C, M = frame.M;
  const auto           exact = coupling::dense_modes(C(others, others), M(others, others));
  const SparseCholesky factor(frame.C, held);
  for (const int below : {1, 12, 30})
    EXPECT_EQ(
        factor.inertia(frame.C, frame.M, std::pow(0.5 * (exact.omega(below) + exact.omega(below - 1)), 2)).negative,
        below);
}

TEST(Inertia, AdmitsMassesWhereThereIsNoStiffness)
{
  const auto frame = block();
  auto       M     = frame.M;
  const int  n     = int(M.rows());
  for (int i = 0; i < n / 2; ++i)
    M.coeffRef(i, n - 1 - i) = M.coeffRef(n - 1 - i, i) = 0.3;
  M.makeCompressed();
  const auto           exact = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(M));
  const SparseCholesky factor(frame.C);
  EXPECT_EQ(factor.inertia(frame.C, M, std::pow(0.5 * (exact.omega(9) + exact.omega(10)), 2)).negative, 10);
}

TEST(NodeOrdering, IsAPermutationThatKeepsNodesTogether)
{
  const auto     frame = block();
  std::vector<int> order = coupling::node_ordering(frame.C, {});
  for (std::size_t k = 0; k < order.size(); k += 3)
    EXPECT_EQ(order[k] / 3, order[k + 2] / 3);
  std::sort(order.begin(), order.end());
  std::vector<int> all(frame.C.rows());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

} // namespace
} // namespace gestell
