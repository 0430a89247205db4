// Machines at random whose motions must obey what holds of all motions: docs/develop/random_machines.md.

#include "tests/random_machines/findings_of.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using RandomMachines = ::testing::TestWithParam<std::uint64_t>;

TEST_P(RandomMachines, ObeyWhatHoldsOfAllMotions)
{
  EXPECT_EQ(findings_of(GetParam()), "");
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, RandomMachines,
                         ::testing::Values(1, 2, 3, 5, 6, 8, 9, 10, 12, 14, 15, 16, 18, 21, 22, 24, 28, 34, 39, 58, 68,
                                           72));

/// Of the wider generator: cam, belt, planets, rack; prescribed motion and unbalance; journal, yielding pin, loads that
/// turn; switches; oil.
INSTANTIATE_TEST_SUITE_P(OfEachWiderKind, RandomMachines,
                         ::testing::Values(2204, 2205, 2222, 2223, 2225, 2229, 2230, 2242, 2243, 2247, 2249, 2299));

TEST(RandomMachine, IsTheSameOnEveryComputer)
{
  // FNV-1a of the first scenes.  Libraries of mathematics may differ in the last digit; four are written.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    for (const char letter : random_machine(seed).scene)
      hash = (hash ^ std::uint64_t(static_cast<unsigned char>(letter))) * 0x100000001b3u;
  EXPECT_EQ(hash, 0xc2f450cdaf75a724u);
}

} // namespace
} // namespace gestell::tests
