// Products of small matrices in packets, against plain sums.

#include "coupling/algebra/packed_matrix.h"
#include "tests/support/test.h"

#include <Eigen/Core>

namespace gestell::tests
{
namespace
{

using coupling::PackedMatrix;

/// Every size from none to three packets and a remainder, on which a different loop ends.
TEST(PackedMatrix, MultipliesAsPlainSumsDoInEverySize)
{
  for (Eigen::Index rows = 0; rows <= 15; ++rows)
    for (Eigen::Index cols = 0; cols <= 19; ++cols)
    {
      const Eigen::MatrixXd A = Eigen::MatrixXd::Random(rows, cols);
      const Eigen::VectorXd x = Eigen::VectorXd::Random(cols), z = Eigen::VectorXd::Random(rows);
      const PackedMatrix    packed(A);
      constexpr double      outside = 7., factor = -0.5;
      Eigen::VectorXd       y    = Eigen::VectorXd::Constant(PackedMatrix::padded(rows), outside),
                      within     = Eigen::VectorXd::Constant(rows + 1, outside),
                      transposed = Eigen::VectorXd::Constant(cols + 1, outside);
      packed.add_product(x.data(), y.data());
      packed.add_product_within(x.data(), within.data(), factor);
      packed.add_transposed_product(z.data(), transposed.data(), factor);
      const double rounding = 40. * std::numeric_limits<double>::epsilon(); // sums of at most 19 terms below 8
      const auto   is_sum   = [&](const Eigen::VectorXd &found, const Eigen::VectorXd &sum) {
        return sum.size() == 0 || (found.head(sum.size()).array() - outside - sum.array()).abs().maxCoeff() < rounding;
      };
      EXPECT_TRUE(is_sum(y, A * x)) << rows << " x " << cols;
      EXPECT_TRUE(is_sum(within, factor * A * x)) << rows << " x " << cols;
      EXPECT_TRUE(is_sum(transposed, factor * A.transpose() * z)) << rows << " x " << cols;
      EXPECT_EQ(within[rows], outside);
      EXPECT_EQ(transposed[cols], outside);
    }
}

} // namespace
} // namespace gestell::tests
