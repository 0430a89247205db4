// What bounds the damage of points: cycles of histories that are close to each other, coarse loads,
// docs/theory/life.md.

#include "apps/analysis/life/damage/point_bounds.h"
#include "tests/support/notched_plate.h"
#include "tests/support/test.h"

#include <numeric>

namespace gestell::tests
{
namespace
{

using namespace apps;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd walk(int n, std::mt19937 &random)
{
  std::normal_distribution<> step;
  VectorXd                   x = VectorXd::Zero(n);
  for (int k = 1; k < n; ++k)
    x[k] = x[k - 1] + step(random);
  return x;
}

/// Blocks of a random load.
LoadSequence blocks(std::int64_t n, Residue residue, std::mt19937 &random)
{
  const auto middle = 1 + std::int64_t(random() % std::uint64_t(n - 1));
  return {{{0, middle, double(1 + random() % 3)}, {middle, n, 1. + 0.5 * double(random() % 4)}}, residue};
}

/// Cycles from `low` or below to `high` or above.
double count_over(const std::vector<Cycle> &cycles, double low, double high)
{
  double count = 0.;
  for (const Cycle &cycle : cycles)
    if (cycle.mean - 0.5 * cycle.range <= low && cycle.mean + 0.5 * cycle.range >= high)
      count += cycle.count;
  return count;
}

/// docs/theory/life.md (5); sharp: without the distance some cycles are missing.
TEST(CyclesOfCloseHistories, HaveTurningPointsAtMostTheirDistanceApart)
{
  std::mt19937                     random(11);
  std::uniform_real_distribution<> uniform(-1., 1.);
  int                              missing = 0;
  for (int round = 0; round < 2000; ++round)
  {
    const int    n = 2 + int(random() % 60);
    const double e = 0.5;
    VectorXd     x = walk(n, random), y = x;
    for (double &value : y)
      value += e * uniform(random);
    const auto               load = blocks(n, round % 2 ? Residue::half : Residue::repeated, random);
    const std::vector<Cycle> of_x = count_cycles(x, load), of_y = count_cycles(y, load);
    constexpr double         rounding = 1e-9;
    for (const Cycle &cycle : of_x)
      if (cycle.range > 2. * e)
      {
        const double low = cycle.mean - 0.5 * cycle.range, high = cycle.mean + 0.5 * cycle.range;
        ASSERT_LE(count_over(of_x, low + rounding, high - rounding),
                  count_over(of_y, low + e + rounding, high - e - rounding));
        missing += count_over(of_x, low + rounding, high - rounding) > count_over(of_y, low + 0.8 * e, high - 0.8 * e);
      }
  }
  EXPECT_GT(missing, 0);
}

TEST(CyclesOfALoad, HaveHalfItsTotalVariationAndAreThoseOfItsMirrorImage)
{
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round)
  {
    const VectorXd x   = walk(30, random);
    const auto     sum = [](const std::vector<Cycle> &cycles, double m)
    {
      double total = 0.;
      for (const Cycle &cycle : cycles)
        total += cycle.count * std::pow(cycle.range, m);
      return total;
    };
    const std::vector<Cycle> open = count_cycles(x, single_load(30, Residue::half));
    EXPECT_NEAR(2. * sum(open, 1.), (x.tail(29) - x.head(29)).cwiseAbs().sum(), 1e-12);
    VectorXd there_and_back(60);
    there_and_back << x, x.reverse();
    const std::vector<Cycle> closed = count_cycles(there_and_back, single_load(60, Residue::repeated));
    EXPECT_NEAR(sum(closed, 3.) / sum(open, 3.), 2., 1e-12);
  }
}

std::vector<MeanStress> mean_stresses()
{
  return {{},
          {MeanStress::Rule::goodman, 6e8, 0.},
          {MeanStress::Rule::fkm, 0., 0.3},
          {MeanStress::Rule::fkm, 0., 0.3, true},
          {MeanStress::Rule::eurocode}};
}

/// Equivalent ranges grow with range and mean (of shear its size), are at most the largest factor times the range, and
/// equal the range at the neutral mean.
TEST(MeanStress, GrowsWithRangeAndMean)
{
  std::mt19937                     random(2);
  std::uniform_real_distribution<> range(1e5, 4e8), mean(-5e8, 4e8), more(0., 1e8);
  for (const MeanStress &effect : mean_stresses())
    for (const double ratio : {-1., 0., 0.5})
      for (int round = 0; round < 2000; ++round)
      {
        const double r = range(random), s = mean(random), x = effect.equivalent_range(r, s, ratio);
        const double from = effect.shear ? std::abs(s) : s;
        EXPECT_GE(effect.equivalent_range(r + more(random), from + more(random), ratio), x * (1. - 1e-12));
        EXPECT_NEAR(effect.equivalent_range(r, effect.neutral_mean(r, ratio), ratio), r, 1e-12 * r);
        EXPECT_LE(x, r * effect.largest_factor(s, ratio) * (1. + 1e-12));
      }
}

/// Every state is that of the lines, apart from the stated remainder.
TEST(CoarseLoad, StatesWhatItLeavesOut)
{
  const NotchedPlate plate(30, 600);
  const auto         load   = plate.load();
  const MatrixXd     gram   = (plate.stress.mean.transpose() * plate.stress.mean).cast<double>();
  const auto         states = coupling::principal_states(plate.states, gram);
  EXPECT_LT((states.basis * states.components.transpose() - plate.states).norm(), 1e-9 * plate.states.norm());
  CoarseLoad coarse;
  for (const double tolerance : {2., 0.3, 0.05, 0.})
  {
    coarse              = coarse_load(states, load, tolerance, tolerance == 2. ? nullptr : &coarse);
    const auto   kept   = coarse.components.cols();
    MatrixXd     left   = states.components;
    Eigen::Index chosen = 0;
    VectorXd     change = VectorXd::Zero(left.cols());
    for (const LoadBlock &block : load.blocks)
    {
      left.row(block.first).head(kept) -= coarse.components.row(chosen);
      for (auto k = block.first; k + 1 < block.end; ++chosen)
      {
        const auto steps = coarse.samples[std::size_t(chosen + 1)] - coarse.samples[std::size_t(chosen)];
        for (std::int64_t i = 1; i <= steps; ++i)
        {
          const double part = double(i) / double(steps);
          left.row(k + i).head(kept) -=
              (1. - part) * coarse.components.row(chosen) + part * coarse.components.row(chosen + 1);
          const VectorXd step = (left.row(k + i) - left.row(k + i - 1)).cwiseAbs().transpose();
          EXPECT_TRUE((step.array() <= coarse.slope.col(chosen).array() * (1. + 1e-9) + 1e-6).all());
          change += block.repetitions * step;
        }
        k += steps;
      }
      ++chosen;
    }
    const VectorXd largest = left.cwiseAbs().colwise().maxCoeff().transpose();
    EXPECT_LT((largest - coarse.largest.matrix()).norm(), 1e-9 * states.components.norm());
    EXPECT_NEAR(left.leftCols(states.measured).rowwise().norm().maxCoeff(), coarse.distance,
                1e-9 * states.components.norm());
    EXPECT_LE(coarse.distance, 1.2 * tolerance * states.components.rowwise().norm().maxCoeff() + 1e-6);
    EXPECT_LT((change - coarse.variation.matrix()).head(kept).norm(), 1e-9 * (1. + change.norm()));
    EXPECT_TRUE((coarse.variation.tail(left.cols() - kept) >= change.tail(left.cols() - kept).array()).all());
  }
}

/// docs/theory/life.md (7) to (9): above the damage of every point, and closer from level to level.
TEST(PointBounds, AreAboveTheDamageAndComeCloser)
{
  const NotchedPlate plate(40, 3000);
  std::vector<int>   points(plate.position.size());
  std::iota(points.begin(), points.end(), 0);
  for (const StressMeasure measure :
       {StressMeasure::normal, StressMeasure::signed_von_mises, StressMeasure::critical_plane})
    for (const MeanStress &effect : mean_stresses())
    {
      const DamageRule   rule{table_curve({{1e4, 2e8}, {1e6, 6e7}, {1e8, 2e7}}, 1., -1.), effect, Miner::original};
      const DamageSearch search = plate.search(measure, 1);
      const LoadSequence load   = plate.load();
      PointStresses      stresses(plate.stress, plate.states, load, rule, search);
      PointBounds        bounds(stresses, points);
      ASSERT_GE(bounds.n_levels(), 2);
      double first = 0., last = 0.; // largest damage / bound of a point
      for (int level = 0; level < bounds.n_levels(); ++level)
      {
        last = 0.;
        for (const int i : points)
        {
          const double   damage = point_damage(plate.stress, plate.states, load, rule, search, i).damage;
          const MatrixXd S      = stresses.matrices({i});
          const MatrixXd rows   = stresses.is_signed() ? S : MatrixXd(stresses.rows(i) * S);
          const double   bound  = bounds.of_rows(rows, level).maxCoeff();
          ASSERT_GE(bound, damage) << "point " << i << ", level " << level;
          if (damage > 0.)
            last = std::max(last, damage / bound);
        }
        first = level == 0 ? last : first;
      }
      EXPECT_GT(last, 0.5);
      EXPECT_GT(last, first);
    }
}

/// The same for random stresses and loads, with a tensile strength that some means exceed.
TEST(PointBounds, AreAboveTheDamageOfRandomLoads)
{
  std::mt19937               random(7);
  std::normal_distribution<> normal;
  for (int round = 0; round < 500; ++round)
  {
    const int    n = 1 + int(random() % 5), samples = 8 + int(random() % 300);
    NotchedPlate plate(3, samples, n);
    for (float &stress : plate.stress.mean.reshaped())
      stress = float(normal(random));
    for (int j = 0; j < n; ++j)
      plate.states.row(j) = 3e7 / (1. + 2. * j) * walk(samples, random).transpose();
    if (round % 3) // a smooth load
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < samples; ++k)
          plate.states(j, k) = 5e7 * (0.3 * j + std::sin(0.03 * (1 + round % 7) * k + j) / (1. + j));
    const auto         load = blocks(samples, round % 2 ? Residue::half : Residue::repeated, random);
    const DamageRule   rule{table_curve({{1e4, 2e8}, {1e6, round % 5 ? 6e7 : 1.5e8}, {1e8, 2e7}}, 1., -1.),
                          mean_stresses()[random() % 5], Miner(random() % 3)};
    const DamageSearch search =
        plate.search(round % 4 ? StressMeasure::signed_von_mises : StressMeasure::critical_plane, 1);
    PointStresses stresses(plate.stress, plate.states, load, rule, search);
    PointBounds   bounds(stresses, {0, 1, 2});
    for (int i = 0; i < 3; ++i)
      for (int level = 0; level < bounds.n_levels(); ++level)
      {
        const MatrixXd S    = stresses.matrices({i});
        const MatrixXd rows = stresses.is_signed() ? S : MatrixXd(stresses.rows(i) * S);
        ASSERT_GE(bounds.of_rows(rows, level).maxCoeff(),
                  point_damage(plate.stress, plate.states, load, rule, search, i).damage)
            << "round " << round << ", level " << level;
      }
  }
}

} // namespace
} // namespace gestell::tests
