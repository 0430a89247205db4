// What cancels leaves nothing, whatever direction an axis has: no motion of 1e-17 that a joint could take for one.

#include "tests/support/jointed_machines.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

Vector3 direction(int number)
{
  const double z = std::sin(1.3 * number), phi = 2.4 * number, r = std::sqrt(1. - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

TEST(TiltedAxis, ARotorOnTheGroundHasItsAngleAlone)
{
  for (int number = 1; number <= 200; ++number)
  {
    MachineModel machine;
    machine.add_rotor("rotor", direction(number), 1., 0., "ground");
    EXPECT_EQ(machine.place("rotor", {0.3, -0.2, 0.7}).measures.size(), 1u) << number;
  }
}

TEST(TiltedAxis, ASliderOnTheGroundDoesNotMoveAcrossIt)
{
  using coupling::operator-, coupling::operator*;
  for (int number = 1; number <= 200; ++number)
  {
    const Vector3 a = direction(number);
    MachineModel  machine;
    machine.add_slider("slider", a, 1., "ground");
    const auto       &motion = machine.marker("slider");
    coupling::Measure along  = motion.along(a);
    ASSERT_EQ(along.size(), 1u);
    for (int d = 0; d < 3; ++d)
      EXPECT_TRUE((motion.translation[d] - a[d] * along).empty()) << number;
  }
}

} // namespace
} // namespace gestell::tests
