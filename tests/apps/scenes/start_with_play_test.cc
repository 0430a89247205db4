// Machines with play that turn from the first instant: plays closed by weight and inertia, no impact of the start.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::with;
using ::testing::HasSubstr;

constexpr double g = 9.81, speed = 5. * M_PI; ///< 150 1/min

const std::string slow = "150 rpm";

std::string steady(const std::string &angle, const std::string &crank = slow)
{
  return start("rule = 'steady'\nq = { crank = '" + angle + "' }\nv = { crank = '" + crank + "' }");
}

/// A journal instead of a revolute joint.
std::string worn(const std::string &name, const std::string &from, const std::string &to, const std::string &at,
                 const std::string &gap)
{
  return element(name, "journal bearing",
                 {{"from", from},
                  {"to", to},
                  {"at", at},
                  {"axis", "[0, 1, 0]"},
                  {"clearance", gap},
                  {"stiffness", "50 kN/mm"},
                  {"restitution", "0.4"},
                  {"impact_speed", "0.1 m/s"}});
}

/// Crank of 50 mm upright, rod of 200 mm, ram along x; its pins are `crank pin` and `wrist pin`.
std::string slider_crank(const std::string &pins, const std::string &end)
{
  return "gravity = [0, 0, -9.81]\n" + rotor_body("crank", "6 kg m^2", "[0, 1, 0]", {{"position", "[0, 0, 0]"}}) +
         planar_body("rod", "0.8 kg", "4e-3 kg m^2", "['0.096824583655185426 m', 0, '25 mm']") +
         slider_body("ram", "1.4 kg", "[1, 0, 0]", {{"position", "['0.19364916731037085 m', 0, 0]"}}) + pins +
         steps("10 us", end) +
         signals("F = 'crank_pin." + std::string(pins.find("[element.crank_pin]") == 0 ? "force" : "resultant") +
                     "', v = 'ram.velocity', w = 'rod.speed', x = 'rod.vx', z = 'rod.vz', n = 'crank.speed'",
                 {{"step", "0.1 ms"}});
}

const std::string crank_pin = "[0, 0, '50 mm']", wrist_pin = "['0.19364916731037085 m', 0, 0]";

std::string with_worn_pin(const std::string &gap, const std::string &end)
{
  return slider_crank(
      worn("crank_pin", "rod", "crank", crank_pin, gap) + revolute("wrist_pin", "rod", "ram", wrist_pin), end);
}

std::string with_two_worn_pins(const std::string &gap, const std::string &end)
{
  return slider_crank(
      worn("crank_pin", "rod", "crank", crank_pin, gap) + worn("wrist_pin", "rod", "ram", wrist_pin, gap), end);
}

std::string ideal(const std::string &end)
{
  return slider_crank(revolute("crank_pin", "rod", "crank", crank_pin) + revolute("wrist_pin", "rod", "ram", wrist_pin),
                      end);
}

const std::vector<std::string> angles = {"0 deg", "50 deg", "130 deg", "200 deg", "310 deg"};

/// Largest amount of a column from the row `first` to the row before `last`.
double largest(const SceneRun &motion, const std::string &name, std::size_t first, std::size_t last)
{
  const std::size_t column = motion.column(name);
  double            most   = 0.;
  for (std::size_t row = first; row < last; ++row)
    most = std::max(most, std::abs(motion.at(row, column)));
  return most;
}

// The play moves bodies by its own size, so that velocities differ by some gap/r of those with ideal joints.
TEST(StartWithPlay, VelocitiesAreThoseOfTheMachineWithIdealJoints)
{
  constexpr double gap = 1e-8, r = 0.05, far = 100. * gap / r;
  for (const std::string &angle : angles)
  {
    const SceneRun joints = run(ideal("0.1 ms") + steady(angle));
    for (const auto &worn_machine : {with_worn_pin("0.01 um", "0.1 ms"), with_two_worn_pins("0.01 um", "0.1 ms")})
    {
      const SceneRun played = run(worn_machine + steady(angle));
      for (const char *name : {"v", "w", "x", "z", "n"})
      {
        const std::size_t column = joints.column(name);
        EXPECT_NEAR(played.at(0, column), joints.at(0, column), far * speed) << name << " at " << angle;
      }
      // The contact carries what the joint does: weight and inertia.
      const double F = joints.at(0, joints.column("F"));
      EXPECT_NEAR(played.at(0, played.column("F")), F, 1e-3 * F) << angle;
    }
  }
}

// The peak of the start is none of its own: later revolutions have such peaks, too.  Knocks in the play differ by some
// ten percent; a pin that is closed at the speed of the crank has fifteen times as much.
TEST(StartWithPlay, TheFirstPeakIsNotLargerThanThoseOfLaterRevolutions)
{
  for (const std::string &angle : {angles[1], angles[3]})
    for (const auto &machine : {with_worn_pin("0.2 mm", "0.85 s"), with_two_worn_pins("0.2 mm", "0.85 s")})
    {
      const SceneRun    motion = run(machine + steady(angle), {"run.step=50 us"});
      const std::size_t n      = motion.n_rows();
      EXPECT_LE(largest(motion, "F", 0, n / 8), 1.2 * largest(motion, "F", n / 8, n)) << angle;
      EXPECT_THAT(coupling::texts_of(motion.result.findings),
                  ::testing::Not(::testing::Contains(HasSubstr("closes the clearance"))));
    }
}

// What the scene gives no speed starts at rest, with a warning that names the speed r omega of the pin.
TEST(StartWithPlay, AGivenStartWarnsOfTheClosingSpeed)
{
  const std::string scene    = with_worn_pin("0.2 mm", "0.1 ms");
  const SceneRun    standing = run(scene + start("v = { crank = '150 rpm' }"));
  EXPECT_THAT(coupling::texts_of(standing.result.findings),
              ::testing::Contains(HasSubstr("\"crank_pin\" at 0.785 m/s")));
  // Zero that is given is meant.
  const SceneRun meant = run(scene + start("v = { crank = '150 rpm', ram = 0, 'rod.ux' = 0, 'rod.uz' = 0, "
                                           "'rod.angle' = 0 }"));
  EXPECT_THAT(coupling::texts_of(meant.result.findings),
              ::testing::Not(::testing::Contains(HasSubstr("closes the clearance"))));
}

// Claws between flywheel and shaft: the load of the shaft closes them on one side, and they carry its share T J_1/(J_1
// + J_2) of the load, the shaft's own inertia the rest.
TEST(StartWithPlay, ClawsCloseOnTheSideThatTheLoadChooses)
{
  for (const double load : {-30., 30.})
  {
    const SceneRun motion =
        run(rotor_body("flywheel", "2 kg m^2", "[0, 0, 1]") + rotor_body("shaft", "0.5 kg m^2", "[0, 0, 1]") +
            element("claws", "clearance",
                    {{"from", "flywheel"}, {"to", "shaft"}, {"gap", "0.5 deg"}, {"stiffness", "1e5 N m/rad"}}) +
            element("load", "force", {{"from", "shaft"}, {"about", "[0, 0, 1]"}, {"constant", number(load) + " N m"}}) +
            start("rule = 'steady'\nv = { flywheel = '10 rad/s' }") + steps("0.1 ms", "0.2 s") +
            signals("M = 'claws.force', w = 'shaft.speed', s = 'claws.displacement'"));
    EXPECT_NEAR(std::abs(motion.at(0, motion.column("M"))), 30. * 2. / 2.5, 1e-9);
    EXPECT_NEAR(motion.at(0, motion.column("w")), 10., 1e-12);
    // It goes on like that: nothing rattles.
    EXPECT_NEAR(motion.signal("M").max, motion.signal("M").min, 1e-6);
  }
}

// Backlash of gears on a sum of both rims: the wheel turns with the pinion from the first instant.
TEST(StartWithPlay, TeethWithBacklashTurnTogether)
{
  const SceneRun motion =
      run(rotor_body("pinion", "0.1 kg m^2", "[0, 0, 1]") + rotor_body("wheel", "0.4 kg m^2", "[0, 0, 1]") +
          measure("mesh", "sum",
                  {{"terms", "[{ of = 'pinion', factor = '40 mm' }, { of = 'wheel.angle', factor = '80 mm' }]"}}) +
          element("teeth", "clearance", {{"on", "mesh"}, {"gap", "0.1 mm"}, {"stiffness", "50 kN/mm"}}) +
          element("load", "force", {{"from", "wheel"}, {"about", "[0, 0, 1]"}, {"constant", "40 N m"}}) +
          start("rule = 'steady'\nv = { pinion = '20 rad/s' }") + steps("20 us", "20 ms") +
          signals("F = 'teeth.force', w = 'wheel.speed'"));
  // a = M r_2/J_2 / (r_1^2/J_1 + r_2^2/J_2) of the force that brings both rims to one acceleration
  const double F = 40. * 0.08 / 0.4 / (0.0016 / 0.1 + 0.0064 / 0.4);
  EXPECT_NEAR(motion.at(0, motion.column("w")), -10., 1e-12);
  EXPECT_NEAR(std::abs(motion.at(0, motion.column("F"))), F, 1e-6 * F);
  EXPECT_NEAR(motion.signal("F").max, motion.signal("F").min, 1e-4 * F);
}

// A rod with play between crank and slide, with weights: the chain rests on one side of its play.
TEST(StartWithPlay, ARodWithPlayFollowsItsCrank)
{
  const auto machine = [](const std::string &play)
  {
    return "gravity = [0, 0, -9.81]\n" + rotor_body("crank", "50 kg m^2", "[0, 1, 0]", {{"position", "[0, 0, 1]"}}) +
           slider_body("ram", "200 kg", "[0, 0, 1]", {{"position", "[0, 0, 0]"}}) +
           element("rod", "connecting rod",
                   {{"from", "crank"},
                    {"to", "ram"},
                    {"crank_radius", "80 mm"},
                    {"length", "800 mm"},
                    {"stiffness", "900 kN/mm"},
                    {"damping", "50 kN s/m"},
                    {"clearance", play}}) +
           steady("60 deg", "60 rpm") + steps("0.1 ms", "3 s") +
           signals("F = 'rod.force', v = 'ram.velocity'", {{"step", "1 ms"}});
  };
  const SceneRun tight = run(machine("0")), loose = run(machine("0.3 mm"));
  EXPECT_NEAR(loose.at(0, loose.column("v")), tight.at(0, tight.column("v")), 1e-2);
  EXPECT_LE(largest(loose, "F", 0, 300), largest(loose, "F", 300, loose.n_rows()));
}

// A slide in a guide with play rests on its lower plane with half its weight at either end.
TEST(StartWithPlay, ASlideRestsOnItsGuide)
{
  const SceneRun motion =
      run("gravity = [0, 0, -9.81]\n" + planar_body("slide", "5 kg", "0.04 kg m^2", "['0.3 m', 0, 0]") +
          element("guide", "guide with play",
                  {{"from", "ground"},
                   {"to", "slide"},
                   {"at", "['0.3 m', 0, 0]"},
                   {"axis", "[1, 0, 0]"},
                   {"normal", "[0, 0, 1]"},
                   {"length", "0.2 m"},
                   {"gap", "0.1 mm"},
                   {"stiffness", "10 kN/mm"}}) +
          start("rule = 'steady'\nv = { 'slide.ux' = '0.5 m/s' }") + steps("20 us", "50 ms") +
          signals("rear = 'guide.rear.normal_force', front = 'guide.front.normal_force'"));
  for (const char *end : {"rear", "front"})
  {
    EXPECT_NEAR(motion.signal(end).min, 2.5 * g, 1e-6);
    EXPECT_NEAR(motion.signal(end).max, 2.5 * g, 1e-6);
  }
}

// Speeds of both sides that do not fit together make no steady motion; one that drives past stops does.
TEST(StartWithPlay, SpeedsThatContradictEachOtherAcrossAPlayAreRefused)
{
  const auto claws = [](const std::string &speeds)
  {
    return rotor_body("flywheel", "200 kg m^2", "[0, 0, 1]") + rotor_body("shaft", "0.5 kg m^2", "[0, 0, 1]") +
           element("claws", "clearance",
                   {{"from", "flywheel"}, {"to", "shaft"}, {"gap", "0.5 deg"}, {"stiffness", "1e5 N m/rad"}}) +
           start("rule = 'steady'\nv = { " + speeds + " }") + steps("0.1 ms", "1 ms") + signals("w = 'shaft.speed'");
  };
  expect_refusal([&] { run(claws("flywheel = '10 rad/s', shaft = '12 rad/s'")); },
                 "contradict each other across the play of \"claws\", which closes at 2 m/s (or rad/s)");
  EXPECT_NEAR(run(claws("flywheel = '10 rad/s', shaft = '10 rad/s'")).signal("w").max, 10., 1e-9);
  const SceneRun passing =
      run(rotor_body("wheel", "1 kg m^2", "[0, 0, 1]") + slider_body("mass", "2 kg", "[0, 0, 1]") +
          element("stops", "clearance", {{"from", "mass"}, {"gap", "20 mm"}, {"stiffness", "1 kN/mm"}}) +
          start("rule = 'steady'\nv = { wheel = '1 rad/s', mass = '0.1 m/s' }") + steps("0.1 ms", "1 ms") +
          signals("v = 'mass.velocity'"));
  EXPECT_NEAR(passing.signal("v").min, 0.1, 1e-12);
}

// A body that a spring holds between stops far away touches none of them.
TEST(StartWithPlay, StopsFarAwayStayOpen)
{
  const SceneRun motion =
      run("gravity = [0, 0, -9.81]\n" + rotor_body("wheel", "1 kg m^2", "[0, 0, 1]") +
          slider_body("mass", "2 kg", "[0, 0, 1]") +
          element("spring", "spring-damper", {{"from", "mass"}, {"stiffness", "10 N/mm"}}) +
          element("stops", "clearance", {{"from", "mass"}, {"gap", "20 mm"}, {"stiffness", "1 kN/mm"}}) +
          start("rule = 'steady'\nv = { wheel = '1 rad/s' }") + steps("0.1 ms", "10 ms") +
          signals("x = 'mass.displacement', F = 'stops.force'"));
  EXPECT_NEAR(motion.signal("x").min, -2. * g / 1e4, 1e-12);
  EXPECT_NEAR(motion.signal("x").max, -2. * g / 1e4, 1e-12);
  EXPECT_EQ(motion.signal("F").max, 0.);
}

} // namespace
} // namespace gestell::tests
