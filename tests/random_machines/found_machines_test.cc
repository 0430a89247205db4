// Machines at random that found something wrong, which has been cured: docs/develop/random_machines.md.

#include "tests/random_machines/findings_of.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using FoundMachines = ::testing::TestWithParam<std::uint64_t>;

TEST_P(FoundMachines, ObeyWhatHoldsOfAllMotions)
{
  EXPECT_EQ(findings_of(GetParam()), "");
}

/// Peaks between four samples of a long step, and between fixed ones.
INSTANTIATE_TEST_SUITE_P(Extremes, FoundMachines, ::testing::Values(107, 110, 277, 541, 661, 759, 1709, 1887));
/// Power of modes that turn many times in a step; of a prescribed motion of which nobody reads the torque.
INSTANTIATE_TEST_SUITE_P(Energy, FoundMachines, ::testing::Values(738, 851, 1022, 4227));
/// Rates of modes that turn far in a step, between its nodes.
INSTANTIATE_TEST_SUITE_P(InsideSteps, FoundMachines, ::testing::Values(142, 220, 671, 889));
/// Measures that are held, inside a step.
INSTANTIATE_TEST_SUITE_P(HeldRates, FoundMachines, ::testing::Values(164, 1094, 1600));
/// A contact that grazes beside the end of a step; a rate held in a step as short as the clock tells; a switch whose
/// condition holds at the start and is left within the first step.
INSTANTIATE_TEST_SUITE_P(Events, FoundMachines, ::testing::Values(1187, 2140, 7614));
/// A sheet that is severed; a drawing force that rests at its limit.
INSTANTIATE_TEST_SUITE_P(Tools, FoundMachines, ::testing::Values(565, 760, 891, 1096, 1943));
/// A contact that closes inside a step of the twin.
INSTANTIATE_TEST_SUITE_P(Twin, FoundMachines, ::testing::Values(4267));
/// An unbalance takes what rounding leaves of a gear to the frame; what drives a rotor, behind the begin of a start.
INSTANTIATE_TEST_SUITE_P(Accelerations, FoundMachines, ::testing::Values(2300, 5257));

/// What sticks from the start on, with the average force; a body held against a force while a switch looks at it.
INSTANTIATE_TEST_SUITE_P(HeldFromTheStart, FoundMachines, ::testing::Values(6070, 7149, 7198));
/// A formula of the rate that dry friction holds: rounding must not throw its kink.
INSTANTIATE_TEST_SUITE_P(HeldByAnother, FoundMachines, ::testing::Values(8712));
/// Gears carry a given speed to the body with play: its start fits.
INSTANTIATE_TEST_SUITE_P(PlayBehindGears, FoundMachines, ::testing::Values(9452));
/// Forces of joints inside the first step behind an event.
INSTANTIATE_TEST_SUITE_P(BehindEvents, FoundMachines, ::testing::Values(12080));
/// A transition leaves a guard at zero, from where it falls: its turn above zero there is rounding.
INSTANTIATE_TEST_SUITE_P(RoundingAtTheBegin, FoundMachines, ::testing::Values(30919));
/// At rest the sign of a rate is rounding.
INSTANTIATE_TEST_SUITE_P(AtRest, FoundMachines, ::testing::Values(815, 1809, 8375, 12225));
/// A mode that hardly turns in a step and grows by rounding.
INSTANTIATE_TEST_SUITE_P(Guard, FoundMachines, ::testing::Values(7021));
/// Weight moves it further than its scale says; extremes between fixed steps; a play that the start
/// closes; a mode that nothing moves; friction within the tolerance; a piston at its end, and one at the wall of its
/// gas; drives that feed each other through a prescribed motion; a play between bars of which one begins at rest.
INSTANTIATE_TEST_SUITE_P(Judge, FoundMachines,
                         ::testing::Values(6015, 7041, 7122, 8275, 8666, 8884, 8999, 9609, 14299, 20061, 30799));

} // namespace
} // namespace gestell::tests
