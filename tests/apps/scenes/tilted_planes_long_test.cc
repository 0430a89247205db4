// The same as tilted_planes_test.cc in two hundred planes at random.

#include "tests/support/tilted_planes.h"

#include <gtest/gtest.h>

namespace gestell::tests
{
namespace
{

class TwoHundredPlanes : public ::testing::TestWithParam<JointedMachine>
{
};

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

} // namespace
} // namespace gestell::tests
