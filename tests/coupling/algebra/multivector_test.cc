#include "coupling/algebra/multivector.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using coupling::KrylovBasis;
using coupling::MultiVector;
using Eigen::MatrixXd;

/// Most that rounding adds to a sum of so many products of at most this size.
double rounding(Eigen::Index terms, double size = 1.)
{
  return 2.3e-16 * double(terms) * double(terms + 1) * size;
}

MatrixXd irregular(Eigen::Index rows, Eigen::Index columns, double seed)
{
  return MatrixXd::NullaryExpr(rows, columns,
                               [seed](Eigen::Index i, Eigen::Index j) { return std::sin(seed + i * 1.7 + j * j); });
}

/// The n coordinates in an order without rule.
std::vector<int> mixed(int n)
{
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [](int a, int b) { return std::sin(7. * a) < std::sin(7. * b); });
  return order;
}

MultiVector tall(const MatrixXd &X)
{
  MultiVector      result(int(X.rows()), int(X.cols()));
  std::vector<int> order(X.rows());
  std::iota(order.begin(), order.end(), 0);
  result.take(X, order);
  return result;
}

MatrixXd matrix(const MultiVector &X)
{
  MatrixXd         result(X.rows(), X.columns());
  std::vector<int> order(X.rows());
  std::iota(order.begin(), order.end(), 0);
  X.give(result, order);
  return result;
}

/// Rows about tiles and strips of them, columns about panels.
class TallProducts : public testing::TestWithParam<std::tuple<int, int>>
{
protected:
  int n = std::get<0>(GetParam()), columns = std::get<1>(GetParam());
};

TEST_P(TallProducts, AreThoseOfDenseMatrices)
{
  const MatrixXd X = irregular(n, columns, 1.), Y = irregular(n, columns, 2.),
                 F = irregular(columns, columns / 2 + 1, 3.);
  EXPECT_LT((gram(tall(X), tall(Y)) - X.transpose() * Y).cwiseAbs().maxCoeff(), rounding(n));
  MultiVector transformed = tall(X);
  transformed.transform(F);
  ASSERT_EQ(transformed.columns(), F.cols());
  EXPECT_LT((matrix(transformed) - X * F).cwiseAbs().maxCoeff(), rounding(columns));
}

TEST_P(TallProducts, WithASpaceAreThoseOfDenseMatrices)
{
  MatrixXd    Q(n, 0);
  KrylovBasis space(n);
  const auto  append = [&](const MatrixXd &X)
  {
    space.append(tall(X));
    Q.conservativeResize(Eigen::NoChange, Q.cols() + X.cols());
    Q.rightCols(X.cols()) = X;
  };
  const auto expect_same = [&](const MatrixXd &X, int from)
  {
    const MatrixXd part = Q.rightCols(Q.cols() - from), H = irregular(part.cols(), X.cols(), 5.);
    EXPECT_EQ(space.columns(), Q.cols());
    EXPECT_LT((space.project(tall(X), from) - part.transpose() * X).cwiseAbs().maxCoeff(),
              rounding(n, Q.cwiseAbs().maxCoeff()));
    MultiVector rest = tall(X);
    space.subtract(rest, H, from);
    EXPECT_LT((matrix(rest) - (X - part * H)).cwiseAbs().maxCoeff(),
              rounding(part.cols() + 1, std::max(1., Q.cwiseAbs().maxCoeff())));
  };
  append(irregular(n, columns, 1.));
  append(irregular(n, 3, 2.));
  append(irregular(n, columns, 3.));
  expect_same(irregular(n, columns, 4.), 0);
  expect_same(irregular(n, 1, 4.), columns + 3);

  const MatrixXd S = irregular(Q.cols(), columns + 1, 6.);
  space.transform(S);
  Q = (Q * S).eval() / double(Q.cols());
  space.transform(MatrixXd::Identity(Q.cols(), Q.cols()) / double(2 * columns + 3));
  append(irregular(n, 2, 7.));
  expect_same(irregular(n, columns, 4.), 0);
  expect_same(irregular(n, columns, 4.), columns + 1);

  MatrixXd   V;
  const auto order = mixed(n);
  space.give(S.topRows(Q.cols()), order, V);
  EXPECT_LT((V(order, Eigen::all) - Q * S.topRows(Q.cols())).cwiseAbs().maxCoeff(),
            rounding(3 * columns + 6, std::max(1., Q.cwiseAbs().maxCoeff())));
}

INSTANTIATE_TEST_SUITE_P(OfAllShapes, TallProducts,
                         testing::Combine(testing::Values(1, 7, 8, 9, 513, 1100),
                                          testing::Values(1, 4, 8, 16, 17, 40)));

TEST(ReorderedMatrix, LeavesHeldCoordinatesOut)
{
  constexpr int          n     = 50;
  const auto             order = mixed(n);
  const std::vector<int> held{0, 7, 31};
  MatrixXd               dense        = irregular(n, n, 1.);
  dense                               = (dense + dense.transpose()).eval();
  const Eigen::SparseMatrix<double> A = dense.sparseView();
  dense(held, Eigen::all).setZero();
  dense(Eigen::all, held).setZero();
  const MatrixXd X = irregular(n, 20, 3.);
  MultiVector    x(n, 20), y(n, 20);
  x.take(X, order);
  coupling::ReorderedMatrix(A, order, held).multiply(x, y);
  MatrixXd Y(n, 20);
  y.give(Y, order);
  EXPECT_LT((Y - dense * X).cwiseAbs().maxCoeff(), rounding(n, 2.));
}

TEST(ReorderedMatrix, MultipliesRowsOfANodeThatAreAlikeAndOthersBesideThem)
{
  constexpr int nodes = 12, others = 4, n = 3 * nodes + others;
  MatrixXd      dense = MatrixXd::Zero(n, n);
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      if ((i + j) % 3 != 1)
        dense.block<3, 3>(3 * i, 3 * j) = std::sin(1. + i + j) * Eigen::Matrix3d::Identity();
  dense.rightCols(others) = irregular(n, others, 2.);
  dense.topRows(12).rightCols(others).setZero(); // the first nodes alone have three rows that are alike
  dense.bottomRows(others) = dense.rightCols(others).transpose();
  dense.bottomRightCorner(others, others).setIdentity();
  dense(0, 3) = dense(3, 0)           = 0.7; // nor do they all
  const Eigen::SparseMatrix<double> A = dense.sparseView();
  std::vector<int>                  as_they_are(n);
  std::iota(as_they_are.begin(), as_they_are.end(), 0);
  std::vector<int> later = as_they_are; // nodes in another order, their coordinates together
  std::rotate(later.begin(), later.begin() + 9, later.begin() + 3 * nodes);
  for (const auto &order : {as_they_are, later, mixed(n)})
  {
    const MatrixXd X = irregular(n, 20, 3.);
    MultiVector    x(n, 20), y(n, 20);
    x.take(X, order);
    coupling::ReorderedMatrix(A, order, {}).multiply(x, y);
    MatrixXd Y(n, 20);
    y.give(Y, order);
    EXPECT_LT((Y - dense * X).cwiseAbs().maxCoeff(), rounding(n, 2.));
  }
}

} // namespace
} // namespace gestell
