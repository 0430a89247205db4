// Modes of two machines matched by what both tell of them.

#include "coupling/modes/mode_comparison.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace gestell::tests
{
namespace
{

using coupling::compare_modes;

/// Mass-normalised modes of a chain of three masses m_i, k between neighbours and the ground.
Eigen::MatrixXd chain(const Eigen::Vector3d &m, double k = 1e6)
{
  Eigen::Matrix3d K;
  K << 2., -1., 0., -1., 2., -1., 0., -1., 1.;
  const Eigen::Matrix3d                                           M = m.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(k * K, M);
  return solver.eigenvectors(); // V^T M V = E
}

const Eigen::Vector3d masses(3., 700., 0.2);

// V V^T = M^-1: with all modes the apparent masses are those of M, and V^T M V = E.
TEST(ModeComparison, OfAMachineWithItselfIsTheIdentity)
{
  const auto match = compare_modes(chain(masses), chain(masses));
  EXPECT_LT((match.mass - masses).norm(), 1e-9 * masses.norm());
  EXPECT_LT((match.mac - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((match.seen_a - Eigen::Vector3d::Ones()).norm(), 1e-12);
  ASSERT_EQ(match.pairs.size(), 3u);
}

TEST(ModeComparison, DoesNotDependOnUnitsSignsOrOrder)
{
  const Eigen::MatrixXd A = chain(masses), B = chain(Eigen::Vector3d(3.3, 640., 0.25));
  const auto            match = compare_modes(A, B);
  const Eigen::Vector3d units(1e3, 1., 57.3); // mm, degrees
  Eigen::MatrixXd       turned(3, 3);
  turned << -B.col(2), B.col(0), B.col(1);
  const auto other = compare_modes(units.asDiagonal() * A, units.asDiagonal() * turned);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(other.mac(i, 0), match.mac(i, 2), 1e-12);
  ASSERT_EQ(other.pairs.size(), 3u);
  EXPECT_EQ(other.pairs[2].b, 0);
  EXPECT_NE(other.pairs[2].reversed, match.pairs[2].reversed);
}

// A mode of which the shared measure tells 1e-4 of the kinetic energy has no partner, however its MAC comes out.
TEST(ModeComparison, GivesNoPartnerToAModeThatIsNotSeen)
{
  Eigen::RowVector3d A(1., 0.01, 0.3);
  const auto         match = compare_modes(A, A);
  EXPECT_NEAR(match.mac(1, 1), 1., 1e-12);
  for (const auto &pair : match.pairs)
    EXPECT_NE(pair.a, 1);
  EXPECT_FALSE(match.pairs.empty());
}

TEST(ModeComparison, LeavesOutWhatMovesInOneMachineAlone)
{
  Eigen::MatrixXd A = chain(masses), B = A;
  B.row(1).setZero();
  EXPECT_EQ(compare_modes(A, B).mass[1], 0.);
}

// sum_i m_A,k A_ki^2 = 1 of each measure: one mode of three that three measures see has all of it.
TEST(ModeComparison, SeenSumsUpToTheNumberOfMeasures)
{
  const Eigen::MatrixXd A = chain(masses);
  for (int modes = 1; modes <= 3; ++modes)
    EXPECT_NEAR(compare_modes(A.leftCols(modes), A).seen_a.sum(), 3., 1e-12) << modes;
}

} // namespace
} // namespace gestell::tests
