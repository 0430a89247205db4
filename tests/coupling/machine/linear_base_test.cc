#include "coupling/eigensolvers/sparse_modes.h"
#include "coupling/machine/dense_base.h"
#include "coupling/machine/sparse_base.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/LU>

namespace gestell
{
namespace
{

using coupling::DenseBase;
using coupling::ModalRange;
using coupling::SparseBase;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Any matrix, always the same.
MatrixXd irregular(int rows, int columns)
{
  MatrixXd A(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i)
      A(i, j) = std::sin(1.7 * i * i + 2.3 * j + 0.9 * i * j);
  return A;
}

enum class ModalBlock
{
  diagonal,
  full
};

/// Matrices as a reduced frame with a body at each end of its coordinates has them: q1 (6), modes (8), bodies (2);
/// masses in kg beside inertias of 1e-4 kg m^2.
struct CraigBamptonLike
{
  int              n = 16;
  MatrixXd         M, B, C;
  ModalRange       L{6, 8};
  std::vector<int> modal{6, 7, 8, 9, 10, 11, 12, 13};

  explicit CraigBamptonLike(ModalBlock damping)
      : M(MatrixXd::Identity(n, n)), B(MatrixXd::Zero(n, n)), C(MatrixXd::Zero(n, n))
  {
    const std::vector<int> rest{0, 1, 2, 3, 4, 5, 14, 15};
    VectorXd               scale = VectorXd::Constant(8, 3.);
    scale.segment(3, 3).setConstant(1e-2);
    const MatrixXd R    = irregular(8, 8);
    MatrixXd       M_NN = scale.asDiagonal() * (R * R.transpose() + 8. * MatrixXd::Identity(8, 8)) * scale.asDiagonal();
    const MatrixXd M_NL = 0.3 * scale.asDiagonal() * irregular(8, 8);
    M_NN += M_NL * M_NL.transpose();
    M(rest, rest)    = M_NN;
    M(rest, modal)   = M_NL;
    M(modal, rest)   = M_NL.transpose();
    const MatrixXd S = irregular(8, 5); // singular: the machine floats
    C(rest, rest)    = 1e5 * (scale.asDiagonal() * S * S.transpose() * scale.asDiagonal());
    C(rest, rest)    = (0.5 * (C(rest, rest) + C(rest, rest).transpose())).eval();
    for (int j = 0; j < 8; ++j)
      C(modal[j], modal[j]) = 1e4 * (j + 1) * (j + 1);
    if (damping == ModalBlock::full)
    {
      const MatrixXd P = irregular(n, 10);
      B                = 20. * P * P.transpose();
    }
    else
      for (int i = 0; i < n; ++i)
        B(i, i) = 2. + i;
    for (auto *A : {&M, &B, &C})
      *A = (0.5 * (*A + A->transpose())).eval();
  }
};

using DenseBaseOf = ::testing::TestWithParam<ModalBlock>;

TEST_P(DenseBaseOf, MultipliesLikeItsMatrices)
{
  const CraigBamptonLike like(GetParam());
  const DenseBase        base(like.M, like.B, like.C, like.L);
  const VectorXd         x = irregular(like.n, 1);
  VectorXd               y(like.n);
  base.mass_times(x, y);
  EXPECT_LT((y - like.M * x).norm(), 1e-14 * y.norm());
  base.damping_times(x, y);
  EXPECT_LT((y - like.B * x).norm(), 1e-14 * y.norm());
  base.stiffness_times(x, y);
  EXPECT_LT((y - like.C * x).norm(), 1e-14 * y.norm());
}

TEST_P(DenseBaseOf, SolvesWithEveryWeightOfATimeStep)
{
  const CraigBamptonLike like(GetParam());
  const DenseBase        base(like.M, like.B, like.C, like.L);
  const VectorXd         f = irregular(like.n, 1);
  for (const double h : {0., 1e-6, 1e-4, 1e-2})
  {
    VectorXd x(like.n);
    base.factorise(1., h, h * h)->solve(f, x);
    const MatrixXd A        = like.M + h * like.B + h * h * like.C;
    const VectorXd residual = A * x - f;
    // backward stable to a few dozen roundings in the scale of each row
    EXPECT_LT(residual.cwiseAbs().cwiseQuotient(A.cwiseAbs() * x.cwiseAbs()).maxCoeff(), 1e-13) << "h = " << h;
  }
}
/// A x = M h + f + W p, with p known only after x_N of the first two.
TEST(DenseBase, SolvesInTwoPartsAsInOne)
{
  const CraigBamptonLike like(ModalBlock::diagonal);
  const int              n        = like.n;
  MatrixXd               rayleigh = 3. * like.M + 1e-4 * like.C, other = like.B;
  other.topRightCorner(6, n)(Eigen::all, like.modal) = irregular(6, 8); // not along M_NL
  other                                              = (0.5 * (other + other.transpose())).eval();
  const VectorXd h = irregular(n, 1), f = irregular(n, 2).col(1);
  VectorXd       p = VectorXd::Zero(n);
  p[1]             = 3.;
  p[15]            = -2.;
  for (const MatrixXd &B : {like.B, rayleigh, other})
  {
    const DenseBase base(like.M, B, like.C, like.L);
    const auto      solver = base.factorise(1., 1e-3, 1e-6);
    VectorXd        whole(n), x(n), share(n);
    solver->solve(like.M * h + f + p, whole);
    solver->solve(p, share);
    x.setConstant(std::nan(""));
    solver->solve_leading(h, f, x);
    for (const int i : solver->leading())
      x[i] += share[i];
    solver->solve_following(h, f, x);
    EXPECT_LT((x - whole).cwiseAbs().cwiseQuotient(whole.cwiseAbs()).maxCoeff(), 1e-11); // condition of A_red
  }
}

INSTANTIATE_TEST_SUITE_P(BothDampings, DenseBaseOf, ::testing::Values(ModalBlock::diagonal, ModalBlock::full));

TEST(DenseBase, LivesWithMasslessCoordinatesAsLongAsTheStepMatrixIsRegular)
{
  MatrixXd M = MatrixXd::Identity(3, 3), B = MatrixXd::Zero(3, 3), C = 4. * MatrixXd::Identity(3, 3);
  M(1, 1) = 0.;
  const DenseBase base(M, B, C, {});
  VectorXd        x(3);
  base.factorise(1., 0.1, 0.01)->solve(VectorXd::Ones(3), x);
  EXPECT_NEAR(x(1), 1. / 0.04, 1e-12);
  EXPECT_EQ(base.spectrum().size(), 2u);
}

TEST(DenseBase, NamesTheCoordinateThatMakesTheStepMatrixSingular)
{
  MatrixXd M = MatrixXd::Identity(4, 4), zero = MatrixXd::Zero(4, 4);
  M(2, 2) = 0.;
  tests::expect_refusal([&] { DenseBase(M, zero, zero, {0, 1}).factorise(1., 1e-3, 1e-6); }, "coordinate 2");
}

TEST(DenseBase, RefusesWhatItsStructureDoesNotHold)
{
  const MatrixXd E = MatrixXd::Identity(3, 3), zero = MatrixXd::Zero(3, 3);
  MatrixXd       skew = E, coupled = E;
  skew(0, 1)    = 1.;
  coupled(0, 2) = coupled(2, 0) = 0.1;
  EXPECT_THROW(DenseBase(skew, zero, E, {}), std::invalid_argument);
  EXPECT_THROW(DenseBase(E, MatrixXd::Zero(2, 2), E, {}), std::invalid_argument);
  EXPECT_THROW(DenseBase(2. * E, zero, E, {1, 1}), std::invalid_argument);
  EXPECT_THROW(DenseBase(E, zero, coupled, {2, 1}), std::invalid_argument);
  EXPECT_THROW(DenseBase(E, zero, E, {3, 1}), std::invalid_argument);
  EXPECT_NO_THROW(DenseBase(E, zero, E, {2, 1}));
}

/// Fixed-free chain of unit springs and masses: omega_j = 2 sin((2 j - 1) pi / (4 n + 2)).
struct Chain
{
  Eigen::SparseMatrix<double> M, B, C;
  explicit Chain(int n) : M(n, n), B(n, n), C(n, n)
  {
    M.setIdentity();
    for (int i = 0; i < n; ++i)
    {
      C.coeffRef(i, i) = i + 1 < n ? 2. : 1.;
      if (i > 0)
        C.coeffRef(i, i - 1) = C.coeffRef(i - 1, i) = -1.;
    }
    B.coeffRef(n - 1, n - 1) = 0.3;
  }
  static double omega(int n, int j) { return 2. * std::sin((2. * j - 1.) * M_PI / (4. * n + 2.)); }
};

TEST(DenseBase, SpectrumOfAChainIsItsFormula)
{
  const int   n = 12;
  const Chain chain(n);
  const auto  lines = DenseBase(chain.M, 0.02 * chain.C, chain.C, {}).spectrum();
  ASSERT_EQ(lines.size(), 12u);
  for (int j = 1; j <= n; ++j)
  {
    EXPECT_NEAR(lines[j - 1].omega, Chain::omega(n, j), 1e-12);
    EXPECT_NEAR(lines[j - 1].zeta, 0.01 * Chain::omega(n, j), 1e-12); // B = 2 delta C: zeta = delta omega
  }
}

TEST(SparseModes, FindTheLowestOfALongChain)
{
  const int   n = 2000;
  const Chain chain(n);
  const auto  modes = coupling::sparse_modes(chain.C, chain.M, 10);
  for (int j = 1; j <= 10; ++j)
    EXPECT_NEAR(modes.omega(j - 1) / Chain::omega(n, j), 1., 1e-8);
  const MatrixXd E = modes.V.transpose() * (chain.M * modes.V);
  EXPECT_LT((E - MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SparseModes, CountRigidMotionsAsModesOfFrequencyZero)
{
  Chain chain(900);
  chain.C.coeffRef(0, 0) = 1.; // loose at both ends
  const auto modes       = coupling::sparse_modes(chain.C, chain.M, 3);
  EXPECT_EQ(modes.omega(0), 0.);
  EXPECT_NEAR(modes.omega(1), 2. * std::sin(M_PI / 1800.), 1e-9);
}

TEST(SparseBase, WithModalDampingSolvesLikeTheDenseMatrix)
{
  const int         n = 40;
  const Chain       chain(n);
  fem::ModalDamping modal{irregular(n, 5), VectorXd::LinSpaced(5, 0., 2.)}; // the first does not damp
  const SparseBase  base(chain.M, chain.B, chain.C, modal);
  const MatrixXd    B = MatrixXd(chain.B) + modal.Z * modal.d.asDiagonal() * modal.Z.transpose();
  const VectorXd    f = irregular(n, 1);
  VectorXd          x(n), y(n);

  base.factorise(1., 0.5, 0.25)->solve(f, x);
  const MatrixXd A = MatrixXd(chain.M) + 0.5 * B + 0.25 * MatrixXd(chain.C);
  EXPECT_LT((A * x - f).norm(), 1e-12 * f.norm());
  base.damping_times(f, y);
  EXPECT_LT((y - B * f).norm(), 1e-13 * y.norm());

  const auto dense = DenseBase(chain.M, B, chain.C, {}).spectrum(), sparse = base.spectrum();
  ASSERT_EQ(sparse.size(), dense.size());
  for (std::size_t j = 0; j < dense.size(); ++j)
    EXPECT_NEAR(sparse[j].zeta, dense[j].zeta, 1e-9);
}

TEST(SparseBase, NamesTheCoordinateWithoutMassAndStiffness)
{
  Chain chain(5);
  chain.M.coeffRef(3, 3) = 0.;
  const SparseBase base(chain.M, chain.B, chain.C);
  EXPECT_NO_THROW(base.factorise(1., 0.1, 0.01));
  tests::expect_refusal([&] { base.factorise(1., 0., 0.); }, "coordinate 3");
}

} // namespace
} // namespace gestell
