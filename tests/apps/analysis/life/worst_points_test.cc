// Stress measures, the seminorm of damage, and the search of the worst points against counting the cycles of all.

#include "apps/analysis/life/damage/worst_points.h"
#include "tests/support/notched_plate.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

#include <random>

namespace gestell::tests
{
namespace
{

using namespace apps;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double megapascal = 1e6; // [Pa]

coupling::Stress components(const Eigen::Matrix3d &S)
{
  return (coupling::Stress() << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)).finished();
}

coupling::Stress tension(double stress, const Vector3d &along)
{
  return components(stress * along * along.transpose());
}

TEST(StressMeasure, OfAWeldIsTheTractionAcrossAndAlongIt)
{
  const SurfaceDirections weld{Vector3d::UnitZ(), Vector3d::UnitX()};
  const coupling::Stress  sigma = (coupling::Stress() << 1., 2., 3., 4., 5., 6.).finished();
  EXPECT_NEAR(measure_rows(StressMeasure::normal, weld).row(0) * sigma, 2., 1e-15);
  EXPECT_NEAR(measure_rows(StressMeasure::shear, weld).row(0) * sigma, 4., 1e-15);
  EXPECT_THROW(measure_rows(StressMeasure::normal, {Vector3d::UnitZ(), Vector3d::Zero()}), std::invalid_argument);
}

TEST(StressMeasure, HasACriticalPlaneWithinItsStepOfEveryTension)
{
  std::srand(5);
  for (int k = 0; k < 200; ++k)
  {
    const Vector3d    along      = Vector3d::Random().normalized();
    const Vector3d    normal     = along.unitOrthogonal();
    const MeasureRows of_surface = measure_rows(StressMeasure::critical_plane, {normal, Vector3d::Zero()});
    const MeasureRows of_space   = measure_rows(StressMeasure::critical_plane, {});
    EXPECT_GT((of_surface * tension(1., along)).maxCoeff(), std::pow(std::cos(5.01 * M_PI / 180.), 2));
    Eigen::Index best;
    EXPECT_GT((of_space * tension(1., along)).maxCoeff(&best), std::pow(std::cos(10. * M_PI / 180.), 2));
    EXPECT_GT(std::abs(plane_normal(of_space.row(best)).dot(along)), std::cos(10. * M_PI / 180.));
  }
}

TEST(StressMeasure, OfVonMisesHasTheSignOfTheTraceAndItsDerivative)
{
  EXPECT_DOUBLE_EQ(signed_von_mises(tension(5., Vector3d::UnitY())), 5.);
  EXPECT_DOUBLE_EQ(signed_von_mises(tension(-5., Vector3d::UnitY())), -5.);
  std::srand(2);
  const coupling::Stress sigma = coupling::Stress::Random(), change = coupling::Stress::Random();
  EXPECT_NEAR(signed_von_mises_row(sigma) * sigma, signed_von_mises(sigma), 1e-14);
  const double h = 1e-6; // error h^2 of central differences
  EXPECT_NEAR(signed_von_mises_row(sigma) * change,
              (signed_von_mises(sigma + h * change) - signed_von_mises(sigma - h * change)) / (2. * h), 1e-9);
}

std::vector<PointDamage> by_looking_at_all(const NotchedPlate &plate, const DamageRule &rule,
                                           const DamageSearch &search, Residue residue = Residue::repeated)
{
  std::vector<PointDamage> all, worst;
  for (int i = 0; i < plate.stress.n_points(); ++i)
    if (search.counts[i])
      all.push_back(point_damage(plate.stress, plate.states, plate.load(residue), rule, search, i));
  std::sort(all.begin(), all.end(), [](auto &a, auto &b) { return a.damage > b.damage; });
  for (const PointDamage &candidate : all)
    if (int(worst.size()) < search.worst &&
        std::all_of(worst.begin(), worst.end(),
                    [&](auto &w)
                    { return (plate.position[w.point] - plate.position[candidate.point]).norm() >= search.distance; }))
      worst.push_back(candidate);
  return worst;
}

void expect_the_worst(const WorstPoints &found, const std::vector<PointDamage> &all)
{
  ASSERT_EQ(found.worst.size(), all.size());
  ASSERT_GT(all.back().damage, 0.) << "the test must have damage";
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    EXPECT_EQ(found.worst[k].point, all[k].point);
    EXPECT_NEAR(found.worst[k].damage / all[k].damage, 1., 1e-12);
    EXPECT_TRUE(found.worst[k].row.isApprox(all[k].row) || all[k].row.isZero());
  }
}

/// Slopes 3 and 5 with a cut-off, one slope, a falling limit with mean stress, and a
/// curve that is not concave.
std::vector<DamageRule> rules()
{
  const MeanStress fkm{MeanStress::Rule::fkm, 0., 0.2}, goodman{MeanStress::Rule::goodman, 600. * megapascal, 0.};
  return {{eurocode_curve(71. * megapascal, StressKind::direct, 1.), {}, Miner::original},
          {crane_curve(80. * megapascal, 3., StressKind::direct, 1.), {}, Miner::elementary},
          {fkm_curve(fkm_material("steel"), 300. * megapascal, StressKind::direct, 8.), fkm, Miner::consequent},
          {table_curve({{1e4, 200. * megapascal}, {1e5, 150. * megapascal}, {1e7, 20. * megapascal}}, 1., -1.), goodman,
           Miner::elementary}};
}

/// Bending of a cantilever after an impact and under a static load, with shear: the smooth stresses of a reduced frame.
NotchedPlate cantilever(int samples)
{
  NotchedPlate     beam(300, samples, 4);
  constexpr double roots[]{1.8751, 4.6941, 7.8548, 10.9955}; // cos(k) cosh(k) = -1
  for (int j = 0; j < 4; ++j)
  {
    const double k = roots[j], ratio = (std::cosh(k) + std::cos(k)) / (std::sinh(k) + std::sin(k));
    for (std::size_t i = 0; i < beam.position.size(); ++i)
    {
      const double x = k * beam.position[i].y(), y = 0.5 * beam.position[i].x() - 0.5; // along, and off the axis
      const auto   row = 6 * Eigen::Index(i);
      beam.stress.mean.middleRows<6>(row).col(j).setZero();
      beam.stress.mean(row + 1, j) = float(y * (std::cosh(x) + std::cos(x) - ratio * (std::sinh(x) + std::sin(x))));
      beam.stress.mean(row + 3, j) =
          float(0.3 * k * (0.25 - y * y) * (std::sinh(x) - std::sin(x) - ratio * (std::cosh(x) + std::cos(x))));
    }
    for (int t = 0; t < samples; ++t)
    {
      const double phase = k * k * 20. * t / samples;
      beam.states(j, t)  = 1e9 / (k * k) * (0.3 + std::exp(-0.02 * phase) * std::sin(phase));
    }
  }
  return beam;
}

/// On a random field and on a smooth one.
class WorstPointsOf : public ::testing::TestWithParam<StressMeasure>
{
};

TEST_P(WorstPointsOf, AreThoseOfCountingAllPoints)
{
  for (const NotchedPlate &plate : {NotchedPlate(300, 300), cantilever(1000)})
    for (const DamageRule &rule : rules())
    {
      DamageSearch search = plate.search(GetParam(), 4);
      expect_the_worst(worst_points(plate.stress, plate.states, plate.load(), rule, search),
                       by_looking_at_all(plate, rule, search));
      search.distance = 0.2;
      search.factor   = 1.2;
      expect_the_worst(worst_points(plate.stress, plate.states, plate.load(), rule, search),
                       by_looking_at_all(plate, rule, search));
    }
}

TEST_P(WorstPointsOf, AreThoseOfCountingAllPointsUnderEveryRule)
{
  const NotchedPlate plate(60, 1000);
  const auto         curve = [](double knee)
  {
    return table_curve({{1e3, 2e8}, {1e5, knee}, {1e8, 1e7}}, 1., -1.); // slopes that increase, or decrease
  };
  const DamageSearch search = plate.search(GetParam(), 3);
  for (const MeanStress &effect : {MeanStress{},
                                   {MeanStress::Rule::fkm, 0., 0.3},
                                   {MeanStress::Rule::fkm, 0., 0.3, true},
                                   {MeanStress::Rule::goodman, 6e8, 0.},
                                   {MeanStress::Rule::eurocode}})
    for (const Miner miner : {Miner::original, Miner::elementary, Miner::consequent})
      for (const Residue residue : {Residue::repeated, Residue::half})
        for (const double knee : {4e7, 1.2e8})
        {
          const DamageRule rule{curve(knee), effect, miner};
          expect_the_worst(worst_points(plate.stress, plate.states, plate.load(residue), rule, search),
                           by_looking_at_all(plate, rule, search, residue));
        }
}

/// Pure shear has no trace, rounding apart, and a trace that crosses zero all the time has many jumps.
TEST(WorstPoints, OfSignedVonMisesAreFoundWithAndWithoutATrace)
{
  for (const float size : {0.f, 1e-9f, 0.2f})
  {
    NotchedPlate plate(100, 200);
    for (int i = 0; i < 600; ++i)
      plate.stress.mean.row(i) *= i % 6 == 3 ? 1.f : i % 6 == 0 ? size : 0.f;
    const DamageSearch search = plate.search(StressMeasure::signed_von_mises, 3);
    const DamageRule   rule   = rules()[1];
    expect_the_worst(worst_points(plate.stress, plate.states, plate.load(), rule, search),
                     by_looking_at_all(plate, rule, search));
  }
}

TEST(WorstPoints, OfPlanesInSpaceAreThoseOfCountingAll)
{
  const NotchedPlate plate(40, 100);
  DamageSearch       search = plate.search(StressMeasure::critical_plane, 2);
  search.directions.clear();
  expect_the_worst(worst_points(plate.stress, plate.states, plate.load(), rules()[0], search),
                   by_looking_at_all(plate, rules()[0], search));
}

INSTANTIATE_TEST_SUITE_P(Measures, WorstPointsOf,
                         ::testing::Values(StressMeasure::normal, StressMeasure::shear, StressMeasure::signed_von_mises,
                                           StressMeasure::critical_plane));

TEST(WorstPoints, AreFoundWithFewLooks)
{
  const NotchedPlate plate(4000, 200);
  for (const DamageRule &rule : rules())
    for (const StressMeasure measure : {StressMeasure::normal, StressMeasure::critical_plane})
      EXPECT_LT(worst_points(plate.stress, plate.states, plate.load(), rule, plate.search(measure, 1)).looked_at, 400)
          << rule.curve.name;
}

TEST(WorstPoints, CountOnlyIncludedOnesAndMayBeFewer)
{
  const NotchedPlate plate(60, 100);
  const auto         rule   = rules().front();
  DamageSearch       search = plate.search(StressMeasure::normal, 5);
  search.counts.assign(60, 0);
  EXPECT_TRUE(worst_points(plate.stress, plate.states, plate.load(), rule, search).worst.empty());
  search.counts[7] = search.counts[9] = 1;
  EXPECT_EQ(worst_points(plate.stress, plate.states, plate.load(), rule, search).worst.size(), 2u);
  search.directions.clear();
  EXPECT_THROW(worst_points(plate.stress, plate.states, plate.load(), rule, search), std::invalid_argument);
}

/// d ln D / d ln a_j = m s_j for one slope, by central differences of the coordinate's size.
TEST(DamageShares, SumToOneAndAreTheDerivativesOfTheDamage)
{
  NotchedPlate plate(50, 300);
  for (const StressMeasure measure : {StressMeasure::normal, StressMeasure::signed_von_mises})
  {
    const DamageRule   rule   = rules()[1]; // m = 3
    const DamageSearch search = plate.search(measure, 1);
    const PointDamage  worst  = worst_points(plate.stress, plate.states, plate.load(), rule, search).worst.front();
    const VectorXd     shares = damage_shares(plate.stress, plate.states, plate.load(), rule, search, worst);
    EXPECT_NEAR(shares.sum(), 1., 1e-12);
    for (const int j : {0, 1, 3})
    {
      const double h      = 1e-5;
      const auto   scaled = [&](double factor)
      {
        MatrixXd states = plate.states;
        states.row(j) *= factor;
        return std::log(point_damage(plate.stress, states, plate.load(), rule, search, worst.point).damage);
      };
      EXPECT_NEAR((scaled(1. + h) - scaled(1. - h)) / (2. * h), 3. * shares[j], 1e-7);
    }
  }
}

} // namespace
} // namespace gestell::tests
