// A machine does the same in other units of length, mass and time: no threshold in metres, kilograms or seconds
// decides.

#include "tests/support/other_units.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using OtherUnits = ::testing::TestWithParam<JointedMachine>;

TEST_P(OtherUnits, DoNotChangeWhatAMachineDoes)
{
  expect_same_in_other_units(GetParam(), {{12, 0, 0}, {-8, 6, -10}});
}

/// A bar above its pin, which falls until it hangs.
std::string bar_let_go()
{
  return "gravity = [0, 0, -9.81]\n" + planar_body("bar", "2", "0.05", "[0.1, 0, 0.3]") +
         revolute("pin", "ground", "bar", "[0, 0, 0]") + start("rule = 'static'") + steps("10 ms", "0.1 s") +
         signals("x = 'bar.x', z = 'bar.z', phi = 'bar.angle'");
}

TEST(StaticStartInOtherUnits, LetsAMachineGoInTimesOfItsOwn)
{
  const Deviation worst =
      deviation_in_other_units({"bar_let_go", bar_let_go()}, {{0, 0, 18}, {0, 0, -18}, {18, 0, 0}, {-18, 0, 0}});
  EXPECT_LE(worst.value, 1e-10) << worst.signal;
}

/// Shafts in mesh, both of whose speeds are given.
std::string meshed_shafts(double first, double second)
{
  return rotor_body("a", "0.5", "[0, 1, 0]") + rotor_body("b", "0.2", "[0, 1, 0]") +
         joint("mesh", "gear", {{"from", "a"}, {"to", "b"}, {"ratio", "2"}}) +
         start("v = { a = " + number(first) + ", b = " + number(second) + " }") + steps("1 ms", "1 ms") +
         signals("w = 'b.speed'");
}

TEST(SpeedsInOtherUnits, ThatDoNotFitAreRefusedHoweverSlow)
{
  const JointedMachine fit{"fit", meshed_shafts(1e-12, 2e-12)}, contradict{"contradict", meshed_shafts(1e-12, 1e-12)};
  EXPECT_NO_THROW(run_of(fit.tree(), fit.path()));
  EXPECT_THROW(run_of(contradict.tree(), contradict.path()), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Machines, OtherUnits, ::testing::ValuesIn(machines_without_mesh()),
                         [](const auto &info) { return info.param.name; });

} // namespace
} // namespace gestell::tests
