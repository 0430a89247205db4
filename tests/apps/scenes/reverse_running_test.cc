// A drive whose synchronous speed is negative turns the machine as its mirror image does.

#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A rotor against a damper, from a speed.
SceneRun motion(const std::string &type, double synchronous, double speed)
{
  Keys motor = {{"on", "r"}, {"breakdown_torque", "20"}, {"breakdown_slip", "0.2"}, {"ratio", "3"}};
  motor.push_back({"synchronous_speed", number(synchronous) + " 1/min"});
  if (type == "dynamic motor")
    motor.push_back({"time_constant", "20 ms"});
  const test::SceneFolder folder;
  const std::string       text = rotor_body("r", "0.4", "[0, 1, 0]") + element("m", type, motor) +
                           element("f", "spring-damper", {{"from", "r"}, {"damping", "0.05"}}) +
                           start("v = { r = " + number(speed) + " }") + steps("1 ms", "4 s") +
                           signals("a = 'r.angle', w = 'r.speed', T = 'm.torque', s = 'm.slip'");
  return SceneRun(folder.write("scene.toml", text));
}

// Motoring, braking against the field, generating, from speeds of both signs.
TEST(ReverseRunning, IsTheMirrorImageOfRunningForwards)
{
  for (const std::string type : {"asynchronous motor", "dynamic motor"})
    for (const double speed : {-50., 0., 20., 60.}) // synchronous: 34.9 rad/s of the shaft
    {
      const SceneRun forwards = motion(type, 1000., speed), backwards = motion(type, -1000., -speed);
      ASSERT_EQ(forwards.n_rows(), backwards.n_rows());
      for (const std::string name : {"a", "w", "T", "s"})
        for (std::size_t row = 0; row < forwards.n_rows(); ++row)
        {
          const double there = forwards.at(row, forwards.column(name));
          ASSERT_EQ(backwards.at(row, backwards.column(name)), name == "s" ? there : -there)
              << type << ' ' << speed << ": " << name << " in row " << row;
        }
      // It reaches its speed and stays there.
      EXPECT_NEAR(backwards.at(backwards.n_rows() - 1, backwards.column("w")), -34.9, 1.) << type;
    }
}

} // namespace
} // namespace gestell::tests
