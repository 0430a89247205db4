// Invariants of a stress, and the search for the largest among many states.

#include "coupling/frame/stress_search.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Stress components(const Eigen::Matrix3d &S)
{
  return (Stress() << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)).finished();
}

TEST(Stress, HasTheInvariantsOfKnownTensors)
{
  const Stress pull = 5. * Stress::Unit(1), shear = 3. * Stress::Unit(4);
  EXPECT_DOUBLE_EQ(von_mises(pull), 5.);
  EXPECT_DOUBLE_EQ(von_mises(shear), 3. * std::sqrt(3.));
  EXPECT_NEAR(von_mises((Stress() << 7., 7., 7., 0., 0., 0.).finished()), 0., 1e-15) << "pressure changes no shape";

  const PrincipalStresses of_shear = principal_stresses(shear); // tau in the plane y z: +-tau at 45 degrees
  EXPECT_LT((of_shear.values - Eigen::Vector3d(3., 0., -3.)).norm(), 1e-14);
  EXPECT_LT((of_shear.first.cwiseAbs() - Eigen::Vector3d(0., std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-14);
}

TEST(Stress, KeepsItsInvariantsWhenTurned)
{
  const Eigen::Vector3d values(80., 20., -50.);
  const Eigen::Matrix3d R      = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
  const Stress          turned = components(R * values.asDiagonal() * R.transpose());
  EXPECT_NEAR(von_mises(turned), von_mises(components(values.asDiagonal().toDenseMatrix())), 1e-12);
  const PrincipalStresses principal = principal_stresses(turned);
  EXPECT_LT((principal.values - values).norm(), 1e-12);
  EXPECT_NEAR(std::abs(principal.first.dot(R.col(0))), 1., 1e-12);
  EXPECT_GT(principal.first.cwiseAbs().maxCoeff(), 0.);
}

/// Many points with random rows, none of them like another.
ReducedStress random_stress(int points, int n)
{
  ReducedStress stress;
  stress.mean = Eigen::MatrixXf::Random(6 * points, n + 3);
  for (int i = 0; i < points; ++i)
  {
    stress.point.push_back(i);
    stress.nearby.push_back(-1);
    stress.mean.middleRows<6>(6 * i) *= 1.f + float(i % 97);
  }
  stress.deviation = Eigen::MatrixXf::Zero(6 * points, n + 3);
  return stress;
}

/// A vibration in which one shape leads.
MatrixXd states_of_a_run(int n, int count)
{
  const MatrixXd shapes = MatrixXd::Random(n + 3, 4);
  MatrixXd       states(n + 3, count);
  for (int k = 0; k < count; ++k)
    states.col(k) = std::sin(0.11 * k) * shapes.col(0) + 0.1 * std::cos(0.31 * k) * shapes.col(1) +
                    0.03 * std::sin(0.73 * k) * shapes.col(2) + 0.2 * shapes.col(3);
  return states;
}

StressPeak by_looking_at_all(const ReducedStress &stress, const MatrixXd &states, const std::vector<char> &counts)
{
  StressPeak peak;
  for (int k = 0; k < states.cols(); ++k)
  {
    const VectorXd all = stress_field(stress, states.col(k)).von_mises;
    for (int i = 0; i < stress.n_points(); ++i)
      if (counts[i] && all[i] > peak.von_mises)
        peak = {i, k, all[i]};
  }
  return peak;
}

void expect_found_with_few_looks(const StressSearch &found, const StressPeak &all)
{
  EXPECT_EQ(found.peak.point, all.point);
  EXPECT_EQ(found.peak.state, all.state);
  EXPECT_NEAR(found.peak.von_mises, all.von_mises, 1e-9 * all.von_mises);
  EXPECT_LT(found.looked_at, 1000) << "the bounds must spare most points";
}

TEST(StressSearch, FindsWhatLookingAtAllPointsAndStatesFinds)
{
  std::srand(7);
  const ReducedStress stress = random_stress(2000, 9);
  const MatrixXd      states = states_of_a_run(9, 100);
  std::vector<char>   counts(2000, 1);
  for (int round = 0; round < 3; ++round)
  {
    const StressPeak   all   = by_looking_at_all(stress, states, counts);
    const StressSearch found = largest_von_mises(stress, states, counts);
    expect_found_with_few_looks(found, all);
    counts[all.point] = 0; // the next largest
  }
}

/// Coordinates differ by their units as modes [sqrt(kg) m] and accelerations [m/s^2] do.
TEST(StressSearch, IsTrueWhateverTheUnitsOfTheCoordinates)
{
  std::srand(11);
  ReducedStress stress = random_stress(2000, 9);
  MatrixXd      states = states_of_a_run(9, 100);
  for (int i = 0; i < 2000; ++i) // one coordinate stresses those points that the others stress least
    stress.mean.block(6 * i, 4, 6, 1) *= i % 97 < 3 ? 4e-5f : 0.f;
  states.row(4) *= 1e7;
  states.row(5) *= 1e-3;
  const std::vector<char> counts(2000, 1);
  const StressPeak        all   = by_looking_at_all(stress, states, counts);
  const StressSearch      found = largest_von_mises(stress, states, counts);
  expect_found_with_few_looks(found, all);
}

/// A coordinate whose unit is small, so that its stresses per unit are, leads at one point.
TEST(StressSearch, FindsAPeakOfACoordinateInASmallUnit)
{
  std::srand(11);
  ReducedStress stress = random_stress(2000, 9);
  MatrixXd      states = states_of_a_run(9, 100);
  stress.mean.col(4).setZero();
  stress.mean.block(6 * 1940, 4, 6, 1).setConstant(1e-8f);
  stress.mean(6 * 1940, 4) = 3e-8f;
  states *= 1e-9;
  states.row(4).setConstant(1e6);
  states(4, 50)            = 2e6;
  const StressSearch found = largest_von_mises(stress, states, std::vector<char>(2000, 1));
  EXPECT_EQ(found.peak.point, 1940);
  EXPECT_EQ(found.peak.state, 50);
}

TEST(StressSearch, LooksOnlyWherePointsCount)
{
  const ReducedStress stress = random_stress(10, 2);
  EXPECT_EQ(largest_von_mises(stress, MatrixXd::Random(5, 3), std::vector<char>(10, 0)).peak.point, -1);
  std::vector<char> one(10, 0);
  one[6] = 1;
  EXPECT_EQ(largest_von_mises(stress, MatrixXd::Random(5, 3), one).peak.point, 6);
  EXPECT_EQ(largest_von_mises(stress, MatrixXd::Zero(5, 3), one).peak.von_mises, 0.) << "a frame at rest";
}

TEST(Disagreement, IsTheRootMeanSquareOverAPointAndItsNeighbours)
{
  // Points 0 1 2 in a triangle, point 3 apart: pull of 10 in 0; deviations of 1, 2, 3 and 100.
  ReducedStress stress;
  stress.point     = {0, 1, 2, 3};
  stress.nearby    = {-1, -1, -1, -1};
  stress.triangles = {{0, 1, 2}};
  stress.mean = stress.deviation = Eigen::MatrixXf::Zero(24, 4);
  stress.mean(0, 0)              = 10.f;
  for (int i = 0; i < 3; ++i)
    stress.deviation(6 * i, 0) = float(i + 1);
  stress.deviation(18, 0) = 100.f;
  EXPECT_NEAR(disagreement(stress, VectorXd::Unit(4, 0), 0), std::sqrt(14. / 3.) / 10., 1e-7);
}

} // namespace
} // namespace gestell
