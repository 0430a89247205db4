// Modes of machines that would not stay, and of machines with drives, against closed forms.

#include "tests/support/scene_text.h"

#include "apps/scene/build/build_machine.h"
#include "coupling/modes/modes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gestell::tests
{
namespace
{

using test::SceneFolder;

struct Linearised
{
  explicit Linearised(const std::string &text)
  {
    const SceneFolder folder;
    const apps::Scene scene   = apps::read_scene(folder.write("scene.toml", text));
    coupling::Machine machine = apps::build_machine(scene);
    const auto        q       = apps::modes_configuration(scene, machine);
    modes                     = coupling::coupled_modes(machine, q, {}, 20);
    poles                     = coupling::operating_poles(machine, q, apps::initial_state(scene, machine).v, 0., {});
  }
  std::vector<coupling::Mode> modes;
  std::vector<coupling::Pole> poles;
};

const std::string rotor = "[body.r]\ntype = \"rotor\"\naxis = [0, 1, 0]\ninertia = 2\n";
const std::string run   = "[run]\nstep = \"1 ms\"\nend = \"1 s\"\n[output]\nsignals = { a = \"r.angle\" }\n";

std::string pendulum(const std::string &angle)
{
  return "gravity = [0, 0, -9.81]\n[body.r]\ntype = \"planar\"\nnormal = [0, 1, 0]\nmass = 2\ninertia = 0.5\n"
         "position = [0, 0, -1]\n[joint.j]\ntype = \"revolute\"\nfrom = \"ground\"\nto = \"r\"\nat = [0, 0, 0]\n"
         "[modes]\nat = { \"r.angle\" = \"" +
         angle + "\" }\n" + run;
}

TEST(OperatingModes, APendulumOnItsHeadGrowsAsFastAsItSwingsBelow)
{
  const double omega = std::sqrt(2. * 9.81 / (0.5 + 2.)); // m g l / (J + m l^2)
  const auto   below = Linearised(pendulum("0 deg")), above = Linearised(pendulum("180 deg"));
  ASSERT_EQ(below.modes.size(), 1u);
  EXPECT_NEAR(below.modes[0].frequency_hz, omega / (2. * M_PI), 1e-9);
  EXPECT_EQ(below.modes[0].growth, 0.);
  ASSERT_EQ(above.modes.size(), 1u);
  EXPECT_EQ(above.modes[0].frequency_hz, 0.);
  EXPECT_NEAR(above.modes[0].growth, omega, 1e-9);
  EXPECT_TRUE(above.poles.empty()); // there is no drive
}

TEST(OperatingModes, AFreeMotionNeitherVibratesNorGrows)
{
  const auto free = Linearised(rotor + run);
  ASSERT_EQ(free.modes.size(), 1u);
  EXPECT_EQ(free.modes[0].frequency_hz, 0.);
  EXPECT_EQ(free.modes[0].growth, 0.);
}

// 2 s^2 + 4 s + 200 = 0: omega_0 = 10 rad/s, ratio 0.1.
TEST(OperatingModes, ASpeedDriveHoldsItsInertiaLikeASpringAndADamper)
{
  const auto drive = Linearised(rotor +
                                "[element.d]\ntype = \"speed drive\"\non = \"r\"\nspeed = 0\n"
                                "proportional_gain = 4\nintegral_gain = 200\n" +
                                run);
  ASSERT_EQ(drive.poles.size(), 1u);
  EXPECT_NEAR(std::abs(drive.poles[0].s), 10., 1e-6);
  EXPECT_NEAR(drive.poles[0].damping_ratio(), 0.1, 1e-7);
  EXPECT_NEAR(drive.poles[0].frequency_hz(), 10. * std::sqrt(0.99) / (2. * M_PI), 1e-7);
  EXPECT_EQ(drive.poles[0].moves, "r");
}

// J s (T s + 1) + D = 0 with D = 2 M_b/(s_b omega_s) = 200 N m s at no load: s^2 + 2 s + 200 = 0.
TEST(OperatingModes, AMotorThatLagsVibratesAgainstItsRotor)
{
  const auto motor = Linearised(rotor +
                                "[element.d]\ntype = \"dynamic motor\"\non = \"r\"\nbreakdown_torque = 200\n"
                                "breakdown_slip = 0.2\nsynchronous_speed = 10\ntime_constant = 0.5\n"
                                "[start]\nv = { r = 10 }\n" +
                                run);
  ASSERT_EQ(motor.poles.size(), 1u);
  EXPECT_NEAR(std::abs(motor.poles[0].s), std::sqrt(200.), 1e-6);
  EXPECT_NEAR(motor.poles[0].damping_ratio(), 1. / std::sqrt(200.), 1e-7);
}

// Bristles are friction, which does not act here; their lag is a scale of the computation (T = 1 ms), no motion.
TEST(OperatingModes, TellNothingOfBristles)
{
  const std::string bristles = "[element.f]\ntype = \"lugre friction\"\nfrom = \"r\"\nkinetic_force = 10\n"
                               "bristle_stiffness = 1e5\nbristle_damping = 100\n";
  EXPECT_TRUE(Linearised(rotor + bristles + run).poles.empty());
  const std::string drive = "[element.d]\ntype = \"speed drive\"\non = \"r\"\nspeed = 0\nproportional_gain = 4\n"
                            "integral_gain = 200\n";
  const auto        both  = Linearised(rotor + bristles + drive + run);
  ASSERT_EQ(both.poles.size(), 1u); // as of the drive alone
  EXPECT_NEAR(std::abs(both.poles[0].s), 10., 1e-6);
  EXPECT_NEAR(both.poles[0].damping_ratio(), 0.1, 1e-7);
}

// Beyond its breakdown torque the characteristic falls with the speed: s = D/J > 0.
TEST(OperatingModes, AMotorBeyondItsBreakdownGrows)
{
  const auto motor = Linearised(rotor +
                                "[element.d]\ntype = \"asynchronous motor\"\non = \"r\"\nbreakdown_torque = 200\n"
                                "breakdown_slip = 0.2\nsynchronous_speed = 10\n[start]\nv = { r = 5 }\n" +
                                run);
  // Kloss: M = 2 M_b/(s/s_b + s_b/s), slip 0.5; dM/dv = -dM/ds/omega_s.
  const double x = 0.5 / 0.2, slope = 2. * 200. * (1. - 1. / (x * x)) / std::pow(x + 1. / x, 2) / (0.2 * 10.);
  ASSERT_EQ(motor.poles.size(), 1u);
  EXPECT_NEAR(motor.poles[0].s.real(), slope / 2., 1e-6);
  EXPECT_FALSE(motor.poles[0].vibrates());
}

} // namespace
} // namespace gestell::tests
