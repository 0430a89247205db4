// The same as tilted_planes_test.cc in two hundred planes at random, and as other_units_test.cc in seven systems of
// units, each of them alone and all at once.

#include "tests/support/other_units.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using TwoHundredPlanes    = ::testing::TestWithParam<JointedMachine>;
using SevenSystemsOfUnits = ::testing::TestWithParam<JointedMachine>;

TEST_P(TwoHundredPlanes, DoNotChangeWhatAMachineDoes)
{
  std::vector<RigidMotion> motions;
  for (unsigned seed = 1001; seed <= 1200; ++seed)
    motions.push_back({random_rotation(seed)});
  const Deviation worst = expect_same_moved(GetParam(), motions);
  std::cout << GetParam().name << ": worst deviation " << worst.value << " of " << worst.signal << '\n';
}

INSTANTIATE_TEST_SUITE_P(Machines, TwoHundredPlanes, ::testing::ValuesIn(jointed_machines()),
                         [](const auto &machine) { return machine.param.name; });

TEST_P(SevenSystemsOfUnits, DoNotChangeWhatAMachineDoes)
{
  const Deviation worst = expect_same_in_other_units(GetParam(), other_units());
  std::cout << GetParam().name << ": worst deviation " << worst.value << " of " << worst.signal << '\n';
}

INSTANTIATE_TEST_SUITE_P(Machines, SevenSystemsOfUnits, ::testing::ValuesIn(machines_without_mesh()),
                         [](const auto &machine) { return machine.param.name; });

} // namespace
} // namespace gestell::tests
