// Machines at random do the same in other units of length, mass and time: docs/develop/random_machines.md.

#include "tests/random_machines/other_units.h"
#include "tests/support/test.h"

#include <unistd.h>

namespace gestell::tests
{
namespace
{

using RandomUnits = ::testing::TestWithParam<std::uint64_t>;

TEST_P(RandomUnits, DoNotChangeWhatAMachineDoes)
{
  const auto folder = std::filesystem::temp_directory_path() / ("random_units_" + std::to_string(::getpid()));
  for (const Finding &finding : judge_in_other_units(random_machine(GetParam()), folder).findings)
    ADD_FAILURE() << finding.kind << ", " << finding.way << ": " << finding.what << ", " << finding.value << " for "
                  << finding.bound;
  std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Machines, RandomUnits, ::testing::Values(2204, 2210, 2223, 2225, 2228, 2233, 2280, 2299));

} // namespace
} // namespace gestell::tests
