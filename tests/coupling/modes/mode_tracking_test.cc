// Modes of two machines matched by what both tell of them; assignment and tracking of modes on systems of two
// oscillators whose frequencies pass each other.

#include "coupling/modes/mode_comparison.h"
#include "coupling/modes/mode_tracking.h"
#include "tests/support/test.h"

#include <Eigen/Eigenvalues>

namespace gestell::tests
{
namespace
{

using coupling::Mode;
using coupling::TrackedModes;

/// Two oscillators of unit mass and omega^2 = 10 + x, 10 - x (k_1 + x, k_2 - x), coupled by epsilon.
std::vector<Mode> two_oscillators(double x, double epsilon)
{
  Eigen::Matrix2d K;
  K << 10. + x, epsilon, epsilon, 10. - x;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(K);
  std::vector<Mode>                                    modes(2);
  for (int j = 0; j < 2; ++j)
  {
    modes[j].frequency_hz = std::sqrt(solver.eigenvalues()[j]) / (2. * M_PI);
    modes[j].shape        = solver.eigenvectors().col(j);
  }
  return modes;
}

/// Frequencies of line 0 and 1 behind the way from x = -1.05 to 0.95 in `steps`.
TrackedModes followed(double epsilon, int steps, int halvings)
{
  coupling::TrackingOptions options;
  options.lines        = 2;
  options.most_halving = halvings;
  TrackedModes at{-1.05, two_oscillators(-1.05, epsilon), {}};
  for (int k = 1; k <= steps; ++k)
  {
    TrackedModes next;
    next.x     = -1.05 + 2. * k / steps;
    next.modes = two_oscillators(next.x, epsilon);
    coupling::track(at, next, Eigen::Matrix2d::Identity(), options,
                    [&](double x) { return two_oscillators(x, epsilon); });
    at = next;
  }
  return at;
}

bool crossed(const TrackedModes &end) // line 0 begins as the lower one
{
  return end.modes[0].frequency_hz > end.modes[1].frequency_hz;
}

} // namespace

TEST(BestAssignment, HasTheLargestSumOfAllChoices)
{
  Eigen::MatrixXd value(4, 5); // the largest of each row taken one after the other would end with 0.1
  value << 0.9, 0.8, 0.1, 0., 0.2, 0.85, 0.1, 0.2, 0.1, 0., 0.3, 0.79, 0.6, 0.2, 0.1, 0.1, 0.2, 0.55, 0.5, 0.45;
  const std::vector<int> chosen = coupling::best_assignment(value);
  double                 sum    = 0.;
  for (int i = 0; i < 4; ++i)
    sum += value(i, chosen[i]);
  std::vector<int> columns(5);
  std::iota(columns.begin(), columns.end(), 0);
  double best = 0.;
  do
    best = std::max(best, value(0, columns[0]) + value(1, columns[1]) + value(2, columns[2]) + value(3, columns[3]));
  while (std::next_permutation(columns.begin(), columns.end()));
  EXPECT_NEAR(sum, best, 1e-12);
  EXPECT_THROW(coupling::best_assignment(value.transpose()), std::invalid_argument);
}

TEST(ModeTracking, UncoupledOscillatorsCrossAndKeepTheirShapes)
{
  for (const int steps : {1, 7, 10, 40}) // 40: a position lies where both frequencies are the same
  {
    const TrackedModes end = followed(0., steps, 10);
    EXPECT_TRUE(crossed(end)) << steps;
    EXPECT_NEAR(std::abs(end.modes[0].shape[0]), 1., 1e-12) << steps;
  }
}

// Frequencies come as near as 2 epsilon in omega^2 and shapes turn within |x| < epsilon, a fiftieth of the step.
TEST(ModeTracking, WeaklyCoupledOscillatorsVeerAway)
{
  for (const int steps : {1, 7, 10, 40})
  {
    EXPECT_FALSE(crossed(followed(1e-3 * 40. / steps, steps, 10))) << steps;
    const TrackedModes end = followed(1e-3 * 40. / steps, steps, 10);
    EXPECT_GT(std::abs(end.modes[0].shape[1]), 0.99); // the line goes on with the other oscillator
  }
  EXPECT_TRUE(crossed(followed(1e-3, 7, 0))); // without halving the shapes jump over the veering
}

// Any mixture of two shapes of one frequency is a mode; lines take the one that continues them.
TEST(ModeTracking, ShapesOfOneFrequencyAreTurnedToTheOnesBefore)
{
  TrackedModes before{0., two_oscillators(-0.5, 0.), {}}, next;
  const double c = std::cos(0.7), s = std::sin(0.7);
  next.x     = 0.5;
  next.modes = two_oscillators(0., 0.);
  next.modes[0].shape << c, s;
  next.modes[1].shape << -s, c;
  coupling::track(before, next, Eigen::Matrix2d::Identity(), {2},
                  [](double) -> std::vector<Mode> { throw std::invalid_argument("not needed"); });
  for (int j = 0; j < 2; ++j)
    EXPECT_NEAR(next.assurance[j], 1., 1e-12);
  EXPECT_NEAR((next.modes[0].shape - before.modes[0].shape).norm(), 0., 1e-12); // signs as well
}

namespace
{

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
  const auto match = coupling::compare_modes(chain(masses), chain(masses));
  EXPECT_LT((match.mass - masses).norm(), 1e-9 * masses.norm());
  EXPECT_LT((match.mac - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((match.seen_a - Eigen::Vector3d::Ones()).norm(), 1e-12);
  ASSERT_EQ(match.pairs.size(), 3u);
}

TEST(ModeComparison, DoesNotDependOnUnitsSignsOrOrder)
{
  const Eigen::MatrixXd A = chain(masses), B = chain(Eigen::Vector3d(3.3, 640., 0.25));
  const auto            match = coupling::compare_modes(A, B);
  const Eigen::Vector3d units(1e3, 1., 57.3); // mm, degrees
  Eigen::MatrixXd       turned(3, 3);
  turned << -B.col(2), B.col(0), B.col(1);
  const auto other = coupling::compare_modes(units.asDiagonal() * A, units.asDiagonal() * turned);
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
  const auto         match = coupling::compare_modes(A, A);
  EXPECT_NEAR(match.mac(1, 1), 1., 1e-12);
  for (const auto &pair : match.pairs)
    EXPECT_NE(pair.a, 1);
  EXPECT_FALSE(match.pairs.empty());
}

TEST(ModeComparison, LeavesOutWhatMovesInOneMachineAlone)
{
  Eigen::MatrixXd A = chain(masses), B = A;
  B.row(1).setZero();
  EXPECT_EQ(coupling::compare_modes(A, B).mass[1], 0.);
}

// sum_i m_A,k A_ki^2 = 1 of each measure: one mode of three that three measures see has all of it.
TEST(ModeComparison, SeenSumsUpToTheNumberOfMeasures)
{
  const Eigen::MatrixXd A = chain(masses);
  for (int modes = 1; modes <= 3; ++modes)
    EXPECT_NEAR(coupling::compare_modes(A.leftCols(modes), A).seen_a.sum(), 3., 1e-12) << modes;
}

} // namespace
} // namespace gestell::tests
