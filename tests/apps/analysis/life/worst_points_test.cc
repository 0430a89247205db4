// Stress measures, the seminorm of damage, and the search of the worst points against counting the cycles of all.

#include "apps/analysis/life/damage/damage_bounds.h"
#include "apps/analysis/life/damage/worst_points.h"
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

double power_of_damage(const VectorXd &x, Residue residue, double m)
{
  double sum = 0.;
  for (const Cycle &cycle : count_cycles(x, single_load(x.size(), residue)))
    sum += cycle.count * std::pow(cycle.range, m);
  return std::pow(sum, 1. / m);
}

/// docs/theory/life.md (6) on random walks, and its limit: a multiple of the same walk.
TEST(DamageOfASlope, ToThePowerOfItsInverseIsASeminorm)
{
  std::mt19937               random(11);
  std::normal_distribution<> step;
  const auto                 walk = [&](int n)
  {
    VectorXd x = VectorXd::Zero(n);
    for (int k = 1; k < n; ++k)
      x[k] = x[k - 1] + step(random);
    return x;
  };
  double closest = 0.;
  for (int round = 0; round < 300; ++round)
    for (const Residue residue : {Residue::half, Residue::repeated})
      for (const double m : {1., 1.5, 3., 5., 9.})
      {
        const int      n = 2 + int(random() % 60);
        const VectorXd x = walk(n), y = (round % 3 ? walk(n) : (0.7 * x + 0.05 * walk(n)).eval());
        const double   sum   = power_of_damage(x + y, residue, m);
        const double   bound = power_of_damage(x, residue, m) + power_of_damage(y, residue, m);
        ASSERT_LE(sum, bound * (1. + 1e-12)) << n << " samples, m = " << m;
        closest = std::max(closest, sum / std::max(bound, 1e-300));
        EXPECT_NEAR(power_of_damage(-2. * x, residue, m), 2. * power_of_damage(x, residue, m), 1e-12 * (1. + bound));
      }
  EXPECT_GT(closest, 0.95) << "the inequality is sharp for similar walks";
}

/// docs/theory/life.md (11) on walks with random signs, and its limit: zeros of |V| at which the sign changes.
TEST(DamageOfASlope, OfASignedNormIsBoundedByTheNormAndItsJumps)
{
  std::mt19937               random(12);
  std::normal_distribution<> step;
  const double               m     = 3.;
  const auto                 bound = [&](const VectorXd &V, const VectorXd &sign)
  {
    double jumps = 0.;
    for (Eigen::Index k = 1; k < V.size(); ++k)
      jumps += sign[k] != sign[k - 1] ? 0.5 * std::pow(std::abs(V[k]) + std::abs(V[k - 1]), m) : 0.;
    return std::pow(2., 1. - 1. / m) * power_of_damage(V, Residue::half, m) + std::pow(jumps, 1. / m);
  };
  for (int round = 0; round < 500; ++round)
  {
    VectorXd V = VectorXd::Zero(40), sign = VectorXd::Ones(40);
    for (int k = 1; k < 40; ++k)
    {
      V[k]    = V[k - 1] + step(random);
      sign[k] = random() % 8 ? sign[k - 1] : -sign[k - 1];
    }
    const VectorXd s = sign.cwiseProduct(V.cwiseAbs());
    ASSERT_LE(power_of_damage(s, Residue::half, m), bound(V, sign) * (1. + 1e-12)) << round;
  }
  VectorXd V(41), sign(41);
  for (int k = 0; k <= 40; ++k)
  {
    V[k]    = k % 2; // 0 1 0 1 ...
    sign[k] = (k / 2) % 2 ? -1. : 1.;
  }
  EXPECT_NEAR(power_of_damage(sign.cwiseProduct(V), Residue::half, m) / power_of_damage(V, Residue::half, m),
              std::pow(2., 1. - 1. / m), 0.05)
      << "the factor is needed; half cycles at the ends";
}

/// A plate with a notch: smooth fields of each coordinate, three times as large at the notch.
struct Plate
{
  coupling::ReducedStress stress;
  std::vector<Vector3d>   position;
  MatrixXd                states;

  Plate(int points, int samples, int n = 7)
  {
    std::mt19937                     random(4);
    std::normal_distribution<>       normal;
    std::uniform_real_distribution<> uniform;
    stress.mean.resize(6 * points, n);
    MatrixXd x(3, points);
    for (int i = 0; i < points; ++i)
    {
      stress.point.push_back(i);
      stress.nearby.push_back(-1);
      x.col(i) << 2. * uniform(random), uniform(random), 0.;
      position.push_back(x.col(i));
    }
    for (int j = 0; j < n; ++j)
      for (int c = 0; c < 6; ++c)
      {
        const double kx = normal(random), ky = normal(random), phase = 3. * normal(random);
        const double size = c == 2 || c > 3 ? 0.1 : 1.;
        for (int i = 0; i < points; ++i)
        {
          const double notch        = 1. + 4. / (1. + 300. * (x.col(i) - Vector3d(0.6, 0.4, 0.)).squaredNorm());
          stress.mean(6 * i + c, j) = float(notch * size * std::cos(kx * x(0, i) + ky * x(1, i) + phase));
        }
      }
    states.resize(n, samples);
    for (int j = 0; j < n; ++j) // blows that ring, over a static stress
      for (int k = 0; k < samples; ++k)
      {
        const double t = double(k % (samples / 2)) / samples;
        states(j, k)   = 10. * megapascal / (1 + j * j) *
                       (1. + 2. * std::exp(-6. * t) * std::sin(2. * M_PI * 10. * std::pow(1.6, j) * t + j));
      }
  }

  DamageSearch search(StressMeasure measure, int worst) const
  {
    DamageSearch search;
    search.measure  = measure;
    search.counts   = std::vector<char>(position.size(), 1);
    search.worst    = worst;
    search.position = position;
    if (measure != StressMeasure::signed_von_mises)
      search.directions.assign(position.size(), {Vector3d::UnitZ(), Vector3d::UnitX()});
    return search;
  }

  LoadSequence load() const
  {
    const auto n = std::int64_t(states.cols());
    return {{{0, n / 2, 20.}, {n / 2, n - 1, 3.}, {n - 1, n, 2.}}, Residue::repeated}; // the last one a static load
  }
};

std::vector<PointDamage> by_looking_at_all(const Plate &plate, const DamageRule &rule, const DamageSearch &search)
{
  std::vector<PointDamage> all, worst;
  for (int i = 0; i < plate.stress.n_points(); ++i)
    if (search.counts[i])
      all.push_back(point_damage(plate.stress, plate.states, plate.load(), rule, search, i));
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
          {crane_curve(80. * megapascal, StressKind::direct, 1.), {}, Miner::elementary},
          {fkm_curve(fkm_material("steel"), 300. * megapascal, StressKind::direct, 8.), fkm, Miner::consequent},
          {table_curve({{1e4, 200. * megapascal}, {1e5, 150. * megapascal}, {1e7, 20. * megapascal}}, 1., -1.), goodman,
           Miner::elementary}};
}

class WorstPointsOf : public ::testing::TestWithParam<StressMeasure>
{
};

TEST_P(WorstPointsOf, AreThoseOfCountingAllPoints)
{
  const Plate plate(300, 300);
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

/// Pure shear has no trace, rounding apart, and a trace that crosses zero all the time has many jumps.
TEST(WorstPoints, OfSignedVonMisesAreFoundWithAndWithoutATrace)
{
  for (const float size : {0.f, 1e-9f, 0.2f})
  {
    Plate plate(100, 200);
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
  const Plate  plate(40, 100);
  DamageSearch search = plate.search(StressMeasure::critical_plane, 2);
  search.directions.clear();
  expect_the_worst(worst_points(plate.stress, plate.states, plate.load(), rules()[0], search),
                   by_looking_at_all(plate, rules()[0], search));
}

INSTANTIATE_TEST_SUITE_P(Measures, WorstPointsOf,
                         ::testing::Values(StressMeasure::normal, StressMeasure::shear, StressMeasure::signed_von_mises,
                                           StressMeasure::critical_plane));

TEST(WorstPoints, AreFoundWithFewLooks)
{
  const Plate plate(4000, 200);
  for (const DamageRule &rule : rules())
    for (const StressMeasure measure : {StressMeasure::normal, StressMeasure::critical_plane})
      EXPECT_LT(worst_points(plate.stress, plate.states, plate.load(), rule, plate.search(measure, 1)).looked_at, 400)
          << rule.curve.name;
}

TEST(WorstPoints, CountOnlyIncludedOnesAndMayBeFewer)
{
  const Plate  plate(60, 100);
  const auto   rule   = rules().front();
  DamageSearch search = plate.search(StressMeasure::normal, 5);
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
  Plate plate(50, 300);
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
