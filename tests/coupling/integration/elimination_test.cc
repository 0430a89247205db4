// LU factors by a list of multiplications, against dense ones.

#include "coupling/integration/step/elimination.h"
#include "tests/support/test.h"

#include <Eigen/LU>

#include <numeric>
#include <random>

namespace gestell::tests
{
namespace
{

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// A sparse matrix of n rows with a dominant entry in column columns[k] of row rows[k].
Matrix sparse_matrix(int n, const std::vector<int> &rows, const std::vector<int> &columns, std::mt19937 &engine)
{
  std::uniform_real_distribution<double> number(-1., 1.);
  Matrix                                 K(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      K(i, j) = std::abs(number(engine)) < 0.15 ? number(engine) : 0.;
  for (int k = 0; k < n; ++k)
    K(rows[std::size_t(k)], columns[std::size_t(k)]) = n + number(engine);
  return K;
}

TEST(Elimination, SolvesWithEveryMatrixOfItsPattern)
{
  std::mt19937 engine(7);
  for (const int n : {1, 2, 7, 25, 60})
  {
    std::vector<int> rows(std::size_t(n), 0), columns(rows.size());
    std::iota(rows.begin(), rows.end(), 0);
    std::iota(columns.begin(), columns.end(), 0);
    std::shuffle(rows.begin(), rows.end(), engine);
    std::shuffle(columns.begin(), columns.end(), engine);
    Matrix                      K      = sparse_matrix(n, rows, columns, engine);
    Eigen::SparseMatrix<double> sparse = K.sparseView();
    coupling::Elimination       elimination(sparse, rows.data(), columns.data());
    for (int again = 0; again < 3; ++again)
    {
      std::vector<double> &entries = elimination.entries();
      std::fill(entries.begin(), entries.end(), 0.);
      for (int e = 0; e < sparse.nonZeros(); ++e)
        entries[std::size_t(elimination.place(e))] = sparse.valuePtr()[e];
      elimination.factorise();
      const Vector f = Vector::Random(n), x = K.partialPivLu().solve(f);
      Vector       y = f;
      elimination.solve_in_place(y);
      EXPECT_LT((y - x).cwiseAbs().maxCoeff(), 1e-14) << n; // condition below 10, solutions of the order of 1
      double determinant = 1.;
      for (int k = 0; k < n; ++k)
      {
        EXPECT_EQ(elimination.row(k), rows[std::size_t(k)]);
        EXPECT_EQ(elimination.column(k), columns[std::size_t(k)]);
        determinant *= elimination.pivot(k) / n;
      }
      EXPECT_NEAR(std::abs(determinant), std::abs((K / n).determinant()), 1e-13 * std::abs(determinant));
      sparse.coeffs() *= 1.5; // other numbers on the same pattern
      sparse.coeffs()[0] += 0.3;
      K = sparse;
    }
  }
}

} // namespace
} // namespace gestell::tests
