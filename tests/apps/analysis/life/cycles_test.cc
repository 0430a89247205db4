// Rainflow counts: the standard's example, closed cases, and counts by crossings of intervals.

#include "apps/analysis/life/damage/cycles.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace apps;
using Eigen::VectorXd;

/// (range, mean) -> count.
using Counts = std::map<std::pair<double, double>, double>;

Counts counts_of(const std::vector<Cycle> &cycles)
{
  Counts counts;
  for (const Cycle &cycle : cycles)
    counts[{cycle.range, cycle.mean}] += cycle.count;
  return counts;
}

VectorXd values(std::initializer_list<double> x)
{
  return Eigen::Map<const VectorXd>(x.begin(), Eigen::Index(x.size()));
}

VectorXd random_levels(int n, int levels, unsigned seed)
{
  std::mt19937                       random(seed);
  std::uniform_int_distribution<int> level(0, levels - 1);
  return VectorXd::NullaryExpr(n, [&] { return double(level(random)); });
}

Counts counted(const VectorXd &x, Residue residue)
{
  return counts_of(count_cycles(x, single_load(x.size(), residue)));
}

/**
 * Counts of a history of integers without rainflow: half the number of passages between a level <= u and one >= v
 * counts the cycles with min <= u and max >= v, so that second differences over (u, v) count each cycle.
 */
Counts by_crossings(const VectorXd &x, int levels, Residue residue)
{
  const Eigen::Index n      = x.size();
  const auto         passes = [&](int u, int v)
  {
    if (u < 0 || v >= levels)
      return 0;
    int       passages = 0, side = 0; // -1 below u, +1 above v
    const int rounds = residue == Residue::repeated ? 2 : 1;
    for (Eigen::Index k = 0; k < rounds * n; ++k)
    {
      const int now = x[k % n] <= u ? -1 : x[k % n] >= v ? 1 : side;
      passages += side != 0 && now != side && (rounds == 1 || k >= n);
      side = now;
    }
    return passages;
  };
  Counts counts;
  for (int u = 0; u < levels; ++u)
    for (int v = u + 1; v < levels; ++v)
      if (const int twice = passes(u, v) - passes(u - 1, v) - passes(u, v + 1) + passes(u - 1, v + 1))
        counts[{double(v - u), 0.5 * (u + v)}] = 0.5 * twice;
  return counts;
}

TEST(Rainflow, CountsTheExampleOfAstmE1049)
{
  std::map<double, double> ranges; // figure 6 of the standard
  for (const auto &[cycle, count] : counted(values({-2, 1, -3, 5, -1, 3, -4, 4, -2}), Residue::half))
    ranges[cycle.first] += count;
  EXPECT_EQ(ranges, (std::map<double, double>{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1.0}, {9, 0.5}}));
}

TEST(Rainflow, CountsARepeatedHistoryFromItsLargestTurningPoint)
{
  EXPECT_EQ(counted(values({-2, 1, -3, 5, -1, 3, -4, 4, -2}), Residue::repeated),
            (Counts{{{9, 0.5}, 1}, {{7, 0.5}, 1}, {{3, -0.5}, 1}, {{4, 1}, 1}}));
}

TEST(Rainflow, HasOneCyclePerPeriodOfASine)
{
  const int      periods = 7, samples = 40;
  const VectorXd x     = VectorXd::NullaryExpr(periods * samples, [&](Eigen::Index k)
                                               { return 3. + 2. * std::sin(2. * M_PI * double(k) / samples); });
  double         count = 0.;
  for (const Cycle &cycle : count_cycles(x, single_load(x.size(), Residue::repeated)))
  {
    EXPECT_NEAR(cycle.range, 4., 1e-14);
    EXPECT_NEAR(cycle.mean, 3., 1e-14);
    count += cycle.count;
  }
  EXPECT_EQ(count, periods);
}

/// A cos t + B cos k t, k odd: the extremes are A + B and -A - B; if B k^2 > A k each fast period has its cycle.
TEST(Rainflow, HasTheCyclesOfTwoSines)
{
  const double   A = 5., B = 1.;
  const int      k = 9;
  const VectorXd x = VectorXd::NullaryExpr(
      3600, [&](Eigen::Index i)
      { return A * std::cos(2. * M_PI * double(i) / 3600) + B * std::cos(2. * M_PI * k * double(i) / 3600); });
  const auto cycles = count_cycles(x, single_load(x.size(), Residue::repeated));
  EXPECT_EQ(cycles.size(), std::size_t(k));
  const auto largest =
      std::max_element(cycles.begin(), cycles.end(), [](auto &a, auto &b) { return a.range < b.range; });
  EXPECT_NEAR(largest->range, 2. * (A + B), 1e-12);
}

class RandomHistory : public ::testing::TestWithParam<Residue>
{
};

TEST_P(RandomHistory, HasTheCountsOfItsCrossings)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    const VectorXd x = random_levels(20 * int(seed), 12, seed);
    EXPECT_EQ(counted(x, GetParam()), by_crossings(x, 12, GetParam())) << seed;
  }
}

TEST_P(RandomHistory, KeepsItsCountsScaledMirroredAndRefined)
{
  const VectorXd x      = random_levels(400, 30, 5);
  const Counts   counts = counted(x, GetParam());
  Counts         mirrored, scaled;
  for (const auto &[cycle, count] : counts)
  {
    mirrored[{cycle.first, -cycle.second}]        = count;
    scaled[{4. * cycle.first, 4. * cycle.second}] = count;
  }
  EXPECT_EQ(counted(-x, GetParam()), mirrored);
  EXPECT_EQ(counted(4. * x, GetParam()), scaled);
  VectorXd refined(3 * x.size()); // a plateau at each sample and one between
  for (Eigen::Index k = 0; k < x.size(); ++k)
    refined.segment<3>(3 * k) << x[k], x[k], 0.5 * (x[k] + x[std::min(k + 1, x.size() - 1)]);
  EXPECT_EQ(counted(refined, GetParam()), counts);
}

INSTANTIATE_TEST_SUITE_P(Residues, RandomHistory, ::testing::Values(Residue::half, Residue::repeated));

TEST(Rainflow, OfARepeatedHistoryIsThatOfItsReverseAndOfAnyStart)
{
  const VectorXd x = random_levels(300, 40, 3);
  VectorXd       later(300);
  later << x.tail(180), x.head(120);
  EXPECT_EQ(counted(x.reverse(), Residue::repeated), counted(x, Residue::repeated));
  EXPECT_EQ(counted(later, Residue::repeated), counted(x, Residue::repeated));
}

TEST(Rainflow, NeedsMemoryForTheResidueOnly)
{
  std::vector<Cycle> closed;
  Rainflow           rainflow(closed);
  const VectorXd     x = random_levels(20000, 10, 9);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    rainflow.add(x[k], k);
  EXPECT_LE(rainflow.residue().size(), 2u * 10u + 2u) << "ranges grow, then shrink, by at least one of 10 levels";
  for (const Cycle &cycle : closed)
    EXPECT_EQ(std::abs(x[cycle.end] - x[cycle.begin]), cycle.range);
}

/// Blocks with repetitions count as the history written out.
TEST_P(RandomHistory, InBlocksIsThatWrittenOut)
{
  for (unsigned seed = 1; seed <= 30; ++seed)
  {
    std::mt19937     random(seed);
    LoadSequence     load{{}, GetParam()};
    std::vector<int> lengths(1 + random() % 4);
    int              n = 0;
    for (int &length : lengths)
    {
      length = 1 + int(random() % 15);
      load.blocks.push_back({n, n + length, double(1 + random() % 5)});
      n += length;
    }
    const VectorXd      x = random_levels(n, 9, seed + 100);
    std::vector<double> whole;
    for (const LoadBlock &block : load.blocks)
      for (int k = 0; k < int(block.repetitions); ++k)
        whole.insert(whole.end(), x.data() + block.first, x.data() + block.end);
    EXPECT_EQ(counts_of(count_cycles(x, load)),
              counted(Eigen::Map<VectorXd>(whole.data(), Eigen::Index(whole.size())), GetParam()))
        << seed;
  }
}

/// Between a block of +-1 and one of 9 to 11 the load crosses once: one cycle from -1 to 11 per repetition of all.
TEST(LoadSequence, CountsTheTransitionBetweenItsBlocks)
{
  const VectorXd x = values({-1, 1, -1, 9, 11, 9});
  EXPECT_EQ(counts_of(count_cycles(x, {{{0, 3, 1000.}, {3, 6, 50.}}, Residue::repeated})),
            (Counts{{{2, 0}, 1000}, {{2, 10}, 49}, {{12, 5}, 1}}));
}

TEST(LoadSequence, MustHaveSamplesAndRepetitions)
{
  const VectorXd x = VectorXd::Zero(4);
  EXPECT_THROW(count_cycles(x, {{}, Residue::half}), std::invalid_argument);
  EXPECT_THROW(count_cycles(x, {{{0, 5, 1.}}, Residue::half}), std::invalid_argument);
  EXPECT_THROW(count_cycles(x, {{{2, 2, 1.}}, Residue::half}), std::invalid_argument);
  EXPECT_THROW(count_cycles(x, {{{0, 4, 0.5}}, Residue::half}), std::invalid_argument);
  EXPECT_TRUE(count_cycles(x, single_load(4, Residue::half)).empty()) << "a constant has no cycles";
}

/// A sine of n samples a period, shifted by parts of one: its samples miss the peaks by up to (pi/n)^2/2, the parabolas
/// by less than 1/10 (2 pi/n)^4.
TEST(ExtremesBetweenSamples, DoNotChangeWithAShiftOfTheHistory)
{
  for (const int n : {16, 40, 100})
  {
    double missed = 0., left = 0.;
    for (double shift = 0.; shift < 1.; shift += 0.07)
    {
      const auto     load = single_load(3 * n, Residue::half);
      const VectorXd x =
          VectorXd::NullaryExpr(3 * n, [&](Eigen::Index i) { return std::sin(2. * M_PI * (double(i) + shift) / n); });
      const VectorXd between = extremes_between_samples(x, load);
      missed                 = std::max(missed, std::abs(x.maxCoeff() - 1.));
      left                   = std::max(left, std::abs(between.maxCoeff() - 1.));
      EXPECT_LE((between - x).cwiseAbs().maxCoeff(), 0.5 * std::pow(M_PI / n, 2));
    }
    EXPECT_GT(missed, 0.4 * std::pow(M_PI / n, 2));
    EXPECT_LT(left, 0.1 * std::pow(2. * M_PI / n, 4));
  }
}

/// A signed von Mises stress jumps where the trace changes its sign; a corner is an extreme already.
TEST(ExtremesBetweenSamples, LeaveJumpsCornersAndEndsAlone)
{
  for (const VectorXd &x : {values({3, 4, 5, 6, -7, -8, -7, -6}), values({0, 1, 2, 3, 2, 1, 0}), values({2, 1, 2, 1})})
    EXPECT_EQ(extremes_between_samples(x, single_load(x.size(), Residue::half)), x);
  const VectorXd two = values({0, 1, 1.5, 1, 0, 0, 1, 1.5, 1, 0});
  EXPECT_EQ(extremes_between_samples(two, {{{0, 3, 1.}, {3, 10, 1.}}, Residue::half})[2], two[2]) << "end of a block";
}

TEST(RangeMeanMatrix, ContainsEveryCycleAndItsDamageOnce)
{
  const VectorXd      x      = random_levels(300, 50, 4);
  const auto          cycles = count_cycles(x, single_load(300, Residue::half));
  std::vector<double> weights(cycles.size());
  double              counts = 0.;
  for (std::size_t k = 0; k < cycles.size(); ++k)
  {
    weights[k] = cycles[k].range;
    counts += cycles[k].count;
  }
  const RangeMeanMatrix matrix = range_mean_matrix(cycles, weights, 8);
  EXPECT_NEAR(matrix.counts.sum(), counts, 1e-9);
  EXPECT_NEAR(matrix.damage.sum(), std::accumulate(weights.begin(), weights.end(), 0.), 1e-9);
  EXPECT_GT(matrix.counts.row(7).sum(), 0.) << "the largest range";
}

} // namespace
} // namespace gestell::tests
