// S-N curves at their knees, mean stress along lines of constant R, and the three rules of Miner.

#include "apps/analysis/life/damage/damage.h"
#include "tests/support/refusal.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace apps;

constexpr double MPa = 1e6;

std::vector<Cycle> random_cycles(int n, double largest, unsigned seed)
{
  std::mt19937                           random(seed);
  std::uniform_real_distribution<double> share(0., 1.);
  std::vector<Cycle>                     cycles;
  for (int k = 0; k < n; ++k)
    cycles.push_back({largest * share(random), 0., 1. + std::floor(100. * share(random)), 0, 0});
  return cycles;
}

/// EN 1993-1-9, 7.1 (2), (3): limits 0.737 and 0.405 of the category, 0.457 in shear.
TEST(EurocodeCurve, HasTheKneesOfTheStandard)
{
  for (const double category : {160., 80., 36.})
  {
    const SnCurve curve = eurocode_curve(category * MPa, StressKind::direct, 1.);
    EXPECT_NEAR(curve.damage(category * MPa) * 2e6, 1., 1e-12);
    EXPECT_NEAR(curve.pieces[0].from / (category * MPa), 0.737, 5e-4);
    EXPECT_NEAR(curve.damage(curve.pieces[0].from) * 5e6, 1., 1e-12);
    EXPECT_NEAR(curve.pieces[1].damage(curve.pieces[0].from) * 5e6, 1., 1e-12) << "continuous at the knee";
    EXPECT_NEAR(curve.cut_off() / (category * MPa), 0.405, 5e-4);
    EXPECT_NEAR(curve.damage(curve.cut_off()) * 1e8, 1., 1e-12);
    EXPECT_EQ(curve.damage(0.999 * curve.cut_off()), 0.);
    EXPECT_GT(curve.damage(0.999 * curve.cut_off(), true), 0.);
    EXPECT_TRUE(curve.concave());
  }
  const SnCurve shear = eurocode_curve(100. * MPa, StressKind::shear, 1.);
  EXPECT_NEAR(shear.damage(100. * MPa) * 2e6, 1., 1e-12);
  EXPECT_NEAR(shear.cut_off() / (100. * MPa), 0.457, 5e-4);
}

TEST(EurocodeCurve, DividesRangesByThePartialFactor)
{
  const SnCurve curve = eurocode_curve(71. * MPa, StressKind::direct, 1.),
                safe  = eurocode_curve(71. * MPa, StressKind::direct, 1.35);
  for (const double range : {30., 45., 60., 200.})
    EXPECT_NEAR(safe.damage(range * MPa / 1.35) / curve.damage(range * MPa), 1., 1e-12);
}

TEST(SnCurve, NamesTheNearestClass)
{
  expect_refusal([] { eurocode_curve(75. * MPa, StressKind::direct, 1.); }, "nearest one is 71 MPa");
  expect_refusal([] { eurocode_curve(71. * MPa, StressKind::shear, 1.); }, "nearest one is 80 MPa");
  expect_refusal([] { crane_curve(70e0, 3., StressKind::direct, 1.); }, "nearest one is 28 MPa");
  expect_refusal([] { eurocode_curve(80. * MPa, StressKind::direct, 0.); }, "gamma_Mf");
  expect_refusal([] { fkm_material("wood"); }, "grey cast iron");
}

/// EN 13001-3-1: slope 3 of welds, 5 of plain material and shear.
TEST(CraneCurve, IsOneLine)
{
  expect_refusal([] { crane_curve(112. * MPa, 4., StressKind::direct, 1.); }, "give 3 or 5");
  const SnCurve plain = crane_curve(112. * MPa, 5., StressKind::direct, 1.);
  EXPECT_NEAR(plain.damage(1. * MPa) / plain.damage(2. * MPa), 1. / 32., 1e-12);
  const SnCurve curve = crane_curve(112. * MPa, 3., StressKind::direct, 1.25);
  EXPECT_NEAR(curve.damage(112. * MPa / 1.25) * 2e6, 1., 1e-12);
  EXPECT_NEAR(curve.damage(1. * MPa) / curve.damage(2. * MPa), 1. / 8., 1e-12);
  EXPECT_EQ(curve.cut_off(), 0.);
}

/// Steel of 500 MPa: 0.45 R_m at R = -1 and 1e6 cycles, M = 0.35 * 0.5 - 0.1.
TEST(FkmCurve, FollowsFromTheTensileStrength)
{
  const FkmMaterial &steel = fkm_material("steel");
  const SnCurve      curve = fkm_curve(steel, 500. * MPa, StressKind::direct, 1.5);
  EXPECT_NEAR(curve.cut_off(), 2. * 0.45 * 500. * MPa / 1.5, 1.);
  EXPECT_NEAR(curve.damage(curve.cut_off()) * 1e6, 1., 1e-12);
  EXPECT_NEAR(curve.damage(2. * curve.cut_off()) * 1e6, 32., 1e-11);
  EXPECT_NEAR(mean_stress_sensitivity(steel, 500. * MPa, StressKind::direct), 0.075, 1e-15);
  EXPECT_EQ(mean_stress_sensitivity(steel, 200. * MPa, StressKind::direct), 0.) << "never negative";
  const SnCurve aluminium = fkm_curve(fkm_material("wrought aluminium"), 300. * MPa, StressKind::direct, 1.);
  EXPECT_NEAR(aluminium.damage(aluminium.cut_off()) * 1e8, 1., 1e-12);
  EXPECT_NEAR(aluminium.cut_off() / aluminium.pieces[0].from, std::pow(0.01, 1. / 15.), 1e-12);
}

/// Model II of the guideline, of aluminium and austenitic steel: factors 0.74 and 0.83 from 1e6 to 1e8 cycles.
TEST(FkmCurve, FallsFurtherForAusteniticSteel)
{
  for (const auto &[kind, factor] : {std::pair(StressKind::direct, 0.736), std::pair(StressKind::shear, 0.832)})
  {
    const SnCurve curve = fkm_curve(fkm_material("stainless steel"), 600. * MPa, kind, 1.);
    EXPECT_NEAR(curve.cut_off() / curve.pieces[0].from, factor, 5e-4);
  }
  const FkmMaterial &grey = fkm_material("grey cast iron"); // R_m 250 MPa: W 0.34 R_m in tension and in shear, M 0.5
  EXPECT_NEAR(fkm_curve(grey, 250. * MPa, StressKind::shear, 1.).cut_off(), 2. * 0.34 * 250. * MPa, 1.);
  EXPECT_EQ(mean_stress_sensitivity(grey, 250. * MPa, StressKind::direct), 0.5);
}

TEST(TableCurve, PassesThroughItsPointsAndMustFall)
{
  const std::vector<SnPoint> points{{1e4, 300. * MPa}, {1e6, 100. * MPa}, {1e8, 60. * MPa}};
  const SnCurve              curve = table_curve(points, 1., {});
  for (const SnPoint &point : points)
    EXPECT_NEAR(curve.damage(point.range) * point.cycles, 1., 1e-12);
  EXPECT_EQ(curve.cut_off(), 60. * MPa);
  expect_refusal([] { table_curve({{1e4, 3e8}, {1e6, 3e8}}, 1., {}); }, "point 2");
  expect_refusal([] { table_curve({{1e6, 3e8}, {1e4, 1e8}}, 1., {}); }, "does not fall");
  expect_refusal([] { table_curve({{1e4, 3e8}}, 1., {}); }, "at least two");
  expect_refusal([] { table_curve({{1e4, 3e8}, {2e4, 1e8}}, 1., {}); }, "slope");
}

/// Range with the ratio R and the amplitude 1.
double equivalent(const MeanStress &effect, double R, double curve_ratio)
{
  return effect.equivalent_range(2., (1. + R) / (1. - R), curve_ratio);
}

TEST(MeanStress, LeavesACycleOfTheRatioOfTheCurve)
{
  for (const MeanStress &effect :
       {MeanStress{MeanStress::Rule::fkm, 0., 0.3}, MeanStress{MeanStress::Rule::goodman, 50., 0.}})
    for (const double R : {-1., 0., 0.3, 0.6})
      EXPECT_NEAR(equivalent(effect, R, R), 2., 1e-14);
}

/// Haigh diagram of the guideline: the amplitude bearable at R = 0 is 1/(1 + M) of that at R = -1, and so on.
TEST(MeanStress, OfFkmHasFourFieldsThatMeet)
{
  const double     M = 0.3;
  const MeanStress effect{MeanStress::Rule::fkm, 0., M};
  EXPECT_NEAR(equivalent(effect, 0., -1.), 2. * (1. + M), 1e-14);
  EXPECT_NEAR(equivalent(effect, 0.5, -1.), 2. * (1. + M) * (1. + M) / (1. + M / 3.), 1e-14);
  EXPECT_NEAR(equivalent(effect, 0.8, -1.), equivalent(effect, 0.5, -1.), 1e-14) << "R >= 0.5: constant";
  EXPECT_NEAR(equivalent(effect, 5., -1.), 2. * (1. - M), 1e-14) << "R > 1: constant";
  for (const double border : {-1., 1., 3.}) // mean over amplitude
    EXPECT_NEAR(effect.equivalent_range(2., border - 1e-9, -1.), effect.equivalent_range(2., border + 1e-9, -1.), 1e-8);
}

/// EN 1993-1-9, 7.2.1: the tensile part of the range and 60 % of its compressive part.
TEST(MeanStress, OfStressRelievedDetailsReducesCompression)
{
  const MeanStress relieved{MeanStress::Rule::eurocode};
  EXPECT_NEAR(relieved.equivalent_range(100., 50., {}), 100., 1e-12) << "from 0 to 100";
  EXPECT_NEAR(relieved.equivalent_range(100., -50., {}), 60., 1e-12) << "from -100 to 0";
  EXPECT_NEAR(relieved.equivalent_range(100., -20., {}), 30. + 0.6 * 70., 1e-12) << "from -70 to 30";
}

TEST(MeanStress, OfShearHasNoSign)
{
  const MeanStress effect{MeanStress::Rule::fkm, 0., 0.3, true};
  EXPECT_EQ(effect.equivalent_range(2., -1.5, -1.), effect.equivalent_range(2., 1.5, -1.));
  EXPECT_GT(effect.equivalent_range(2., -1.5, -1.), 2.);
  expect_refusal([] { require_valid({MeanStress::Rule::goodman, 5e8, 0., true}, -1.); }, "use that of FKM");
}

TEST(MeanStress, NeverExceedsItsLargestFactor)
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> share(-1., 1.);
  for (const MeanStress &effect :
       {MeanStress{MeanStress::Rule::fkm, 0., 0.4}, MeanStress{MeanStress::Rule::goodman, 3., 0.},
        MeanStress{MeanStress::Rule::fkm, 0., 0.4, true}, MeanStress{MeanStress::Rule::eurocode}})
    for (int k = 0; k < 2000; ++k)
    {
      const double range = std::exp(3. * share(random)), mean = 4. * share(random), R = 0.9 * share(random);
      EXPECT_LE(effect.equivalent_range(range, mean, R), range * effect.largest_factor(mean, R) * (1. + 1e-14));
    }
  EXPECT_TRUE(std::isinf(MeanStress({MeanStress::Rule::goodman, 3., 0.}).equivalent_range(1., 3., -1.)));
  EXPECT_THROW(require_valid({MeanStress::Rule::goodman, 0., 0.}, -1.), std::invalid_argument);
  EXPECT_THROW(require_valid({MeanStress::Rule::fkm, 0., 1.}, -1.), std::invalid_argument);
  EXPECT_THROW(require_valid({}, 1.), std::invalid_argument);
}

/// The limit followed in small steps of damage.
double life_in_steps(const std::vector<Cycle> &cycles, const SnCurve &curve, int steps)
{
  const double q    = curve.pieces.back().slope - 1.;
  double       life = 0.;
  for (int s = 0; s < steps; ++s)
  {
    const double limit = curve.cut_off() * std::pow(1. - (s + 0.5) / steps, 1. / q);
    double       rate  = 0.;
    for (const Cycle &cycle : cycles)
      rate += cycle.range >= limit ? cycle.count * curve.damage(cycle.range, true) : 0.;
    life += 1. / steps / rate;
  }
  return life;
}

TEST(Miner, ConsequentFollowsTheFallingLimit)
{
  DamageRule   rule{fkm_curve(fkm_material("steel"), 500. * MPa, StressKind::direct, 1.), {}, Miner::consequent};
  const auto   cycles = random_cycles(40, 1.2 * rule.curve.cut_off(), 2);
  const auto   with   = [&](Miner miner) { return damage_of(cycles, {rule.curve, rule.mean_stress, miner}); };
  const double steps  = life_in_steps(cycles, rule.curve, 100000);
  EXPECT_NEAR(repetitions_to_failure(with(Miner::consequent)) / steps, 1., 1e-4) << "one of 1e5 steps per cycle";
  EXPECT_LT(with(Miner::original), with(Miner::consequent));
  EXPECT_LT(with(Miner::consequent), with(Miner::elementary));
  EXPECT_EQ(damage_of(random_cycles(40, 0.99 * rule.curve.cut_off(), 2), rule), 0.) << "the limit never falls";
  EXPECT_EQ(damage_of({}, rule), 0.);
}

TEST(Miner, DividesItsDamageAmongTheCycles)
{
  for (const Miner miner : {Miner::original, Miner::elementary, Miner::consequent})
  {
    const DamageRule rule{eurocode_curve(80. * MPa, StressKind::direct, 1.), {}, miner};
    const auto       cycles = random_cycles(60, 100. * MPa, 7);
    const auto       parts  = damage_per_cycle(cycles, rule);
    EXPECT_NEAR(std::accumulate(parts.begin(), parts.end(), 0.) / damage_of(cycles, rule), 1., 1e-12);
    EXPECT_GE(*std::min_element(parts.begin(), parts.end()), 0.);
  }
}

} // namespace
} // namespace gestell::tests
