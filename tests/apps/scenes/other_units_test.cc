// A machine does the same in other units of length, mass and time: no threshold in metres, kilograms or seconds
// decides.

#include "tests/support/other_units.h"

#include <gtest/gtest.h>

namespace gestell::tests
{
namespace
{

class OtherUnits : public ::testing::TestWithParam<JointedMachine>
{
};

TEST_P(OtherUnits, DoNotChangeWhatAMachineDoes)
{
  expect_same_in_other_units(GetParam(), {{12, 0, 0}, {-8, 6, -10}});
}

INSTANTIATE_TEST_SUITE_P(Machines, OtherUnits, ::testing::ValuesIn(machines_without_mesh()),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace gestell::tests
