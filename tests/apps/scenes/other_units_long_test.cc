// The same as other_units_test.cc in seven systems of units, each of them alone and all at once.

#include "tests/support/other_units.h"

#include <gtest/gtest.h>

#include <iostream>

namespace gestell::tests
{
namespace
{

class SevenSystemsOfUnits : public ::testing::TestWithParam<JointedMachine>
{
};

TEST_P(SevenSystemsOfUnits, DoNotChangeWhatAMachineDoes)
{
  const Deviation worst = expect_same_in_other_units(GetParam(), other_units());
  std::cout << GetParam().name << ": worst deviation " << worst.value << " of " << worst.signal << '\n';
}

INSTANTIATE_TEST_SUITE_P(Machines, SevenSystemsOfUnits, ::testing::ValuesIn(machines_without_mesh()),
                         [](const auto &machine) { return machine.param.name; });

} // namespace
} // namespace gestell::tests
