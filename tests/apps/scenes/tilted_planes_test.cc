// A machine does the same wherever it stands in space: seen turned, moved and in a mirror.

#include "tests/support/refusal.h"
#include "tests/support/test.h"
#include "tests/support/tilted_planes.h"

namespace gestell::tests
{
namespace
{

using TiltedPlanes = ::testing::TestWithParam<JointedMachine>;

TEST_P(TiltedPlanes, DoNotChangeWhatAMachineDoes)
{
  std::vector<RigidMotion> motions;
  for (unsigned seed = 1; seed <= 3; ++seed)
    motions.push_back({random_rotation(seed)});
  const double length = GetParam().length;
  motions.push_back({random_rotation(4), length * Eigen::Vector3d(0.3, -1.1, 0.7)});
  motions.push_back({-random_rotation(5), length * Eigen::Vector3d(0.2, 0.4, -0.6)});
  expect_same_moved(GetParam(), motions);
}

INSTANTIATE_TEST_SUITE_P(Machines, TiltedPlanes, ::testing::ValuesIn(jointed_machines()),
                         [](const auto &machine) { return machine.param.name; });

// A crank and a slide that its pin does not move as described: what holds nothing there holds nothing in any plane.
TEST(TiltedPlane, RefusesWhatIsRefusedInOneAlongTheAxes)
{
  const JointedMachine locked{"locked", rotor_body("crank", "0.1", "[0, 1, 0]") +
                                            slider_body("slide", "1", "[1, 0, 0]") +
                                            revolute("pin", "crank", "slide", "[0, 0, 0.1]") + steps("5 ms", "50 ms") +
                                            signals("x = 'slide.displacement'")};
  for (unsigned seed = 1; seed <= 20; ++seed)
    expect_refusal([&] { run_of(moved(locked.tree(), {random_rotation(seed)}).scene, "scene.toml"); },
                   "constrains nothing that could move");
}

} // namespace
} // namespace gestell::tests
