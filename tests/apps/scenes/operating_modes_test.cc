// Modes of machines that would not stay, and of machines with drives, against closed forms.

#include "tests/support/scene_parts.h"

#include "apps/scene/build/build_machine.h"
#include "coupling/modes/modes.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

struct Linearised
{
  explicit Linearised(const std::string &text)
  {
    const apps::Scene scene   = test::scene_of(text);
    coupling::Machine machine = apps::build_machine(scene);
    const auto        q       = apps::modes_configuration(scene, machine);
    modes                     = coupling::coupled_modes(machine, q, {}, 20);
    poles                     = coupling::operating_poles(machine, q, apps::initial_state(scene, machine).v, 0., {});
  }
  std::vector<coupling::Mode> modes;
  std::vector<coupling::Pole> poles;
};

const std::string rotor     = rotor_body("r", "2", "[0, 1, 0]");
const std::string rotor_run = steps("1 ms", "1 s") + signals("a = 'r.angle'");

std::string pendulum(const std::string &angle)
{
  return "gravity = [0, 0, -9.81]\n" + planar_body("r", "2", "0.5", "[0, 0, -1]") +
         revolute("j", "ground", "r", "[0, 0, 0]") + "[modes]\nat = { 'r.angle' = '" + angle + "' }\n" + rotor_run;
}

const std::string drive =
    element("d", "speed drive", {{"on", "r"}, {"speed", "0"}, {"proportional_gain", "4"}, {"integral_gain", "200"}});

std::string motor(const std::string &type, const std::string &speed, const Keys &more = {})
{
  Keys kloss = {{"on", "r"}, {"breakdown_torque", "200"}, {"breakdown_slip", "0.2"}, {"synchronous_speed", "10"}};
  kloss.insert(kloss.end(), more.begin(), more.end());
  return element("d", type, kloss) + start("v = { r = " + speed + " }");
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
  const auto free = Linearised(rotor + rotor_run);
  ASSERT_EQ(free.modes.size(), 1u);
  EXPECT_EQ(free.modes[0].frequency_hz, 0.);
  EXPECT_EQ(free.modes[0].growth, 0.);
}

// 2 s^2 + 4 s + 200 = 0: omega_0 = 10 rad/s, ratio 0.1.
TEST(OperatingModes, ASpeedDriveHoldsItsInertiaLikeASpringAndADamper)
{
  const auto poles = Linearised(rotor + drive + rotor_run).poles;
  ASSERT_EQ(poles.size(), 1u);
  EXPECT_NEAR(std::abs(poles[0].s), 10., 1e-6);
  EXPECT_NEAR(poles[0].damping_ratio(), 0.1, 1e-7);
  EXPECT_NEAR(poles[0].frequency_hz(), 10. * std::sqrt(0.99) / (2. * M_PI), 1e-7);
  EXPECT_EQ(poles[0].moves, "r");
}

// J s (T s + 1) + D = 0 with D = 2 M_b/(s_b omega_s) = 200 N m s at no load: s^2 + 2 s + 200 = 0.
TEST(OperatingModes, AMotorThatLagsVibratesAgainstItsRotor)
{
  const auto poles = Linearised(rotor + motor("dynamic motor", "10", {{"time_constant", "0.5"}}) + rotor_run).poles;
  ASSERT_EQ(poles.size(), 1u);
  EXPECT_NEAR(std::abs(poles[0].s), std::sqrt(200.), 1e-6);
  EXPECT_NEAR(poles[0].damping_ratio(), 1. / std::sqrt(200.), 1e-7);
}

// Bristles are friction, which does not act here; their lag is a scale of the computation (T = 1 ms), no motion.
TEST(OperatingModes, TellNothingOfBristles)
{
  const std::string bristles =
      element("f", "lugre friction",
              {{"from", "r"}, {"kinetic_force", "10"}, {"bristle_stiffness", "1e5"}, {"bristle_damping", "100"}});
  EXPECT_TRUE(Linearised(rotor + bristles + rotor_run).poles.empty());
  const auto both = Linearised(rotor + bristles + drive + rotor_run);
  ASSERT_EQ(both.poles.size(), 1u); // as of the drive alone
  EXPECT_NEAR(std::abs(both.poles[0].s), 10., 1e-6);
  EXPECT_NEAR(both.poles[0].damping_ratio(), 0.1, 1e-7);
}

// Beyond its breakdown torque the characteristic falls with the speed: s = D/J > 0.
TEST(OperatingModes, AMotorBeyondItsBreakdownGrows)
{
  const auto poles = Linearised(rotor + motor("asynchronous motor", "5") + rotor_run).poles;
  // Kloss: M = 2 M_b/(s/s_b + s_b/s), slip 0.5; dM/dv = -dM/ds/omega_s.
  const double x = 0.5 / 0.2, slope = 2. * 200. * (1. - 1. / (x * x)) / std::pow(x + 1. / x, 2) / (0.2 * 10.);
  ASSERT_EQ(poles.size(), 1u);
  EXPECT_NEAR(poles[0].s.real(), slope / 2., 1e-6);
  EXPECT_FALSE(poles[0].vibrates());
}

} // namespace
} // namespace gestell::tests
