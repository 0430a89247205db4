// Rotors and planar bodies are addressed alike: `crank` and `crank.angle` are one rotation.

#include "apps/scene/build/build_machine.h"
#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint, test::quoted, test::scene_of;

/// A body "crank" that turns about z, on a revolute joint if it is planar.
std::string machine(const std::string &type)
{
  const bool rotor = type == "rotor";
  return quoted("[body.crank]\ntype = '" + type + "'\n" +
                (rotor ? "axis = [0, 0, 1]\n" : "normal = [0, 0, 1]\nmass = 3\nposition = [0, 0, 0]\n") +
                "inertia = 2\n[body.other]\ntype = 'rotor'\naxis = [0, 0, 1]\ninertia = 5\n" +
                (rotor ? "" : "[joint.bearing]\ntype = 'revolute'\nfrom = 'ground'\nto = 'crank'\nat = [0, 0, 0]\n"));
}

using Named = ::testing::TestWithParam<std::tuple<std::string, std::string>>;
INSTANTIATE_TEST_SUITE_P(Alike, Named,
                         ::testing::Combine(::testing::Values("rotor", "planar"),
                                            ::testing::Values("crank", "crank.angle")));

std::string with_name(std::string text, const std::string &name)
{
  for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos; at += name.size())
    text.replace(at, 1, name);
  return quoted(text);
}

TEST_P(Named, StartsMotionsAndSignals)
{
  const auto &[type, name] = GetParam();
  const auto scene         = scene_of(machine(type) + with_name("[start]\nq = { '@' = '30 deg' }\nv = { '@' = 4 }\n"
                                                                        "[output]\nsignals = { a = '@', b = 'crank.angle' }\n",
                                                                name));
  auto       machine       = apps::build_machine(scene);
  const auto start         = apps::initial_state(scene, machine);
  EXPECT_DOUBLE_EQ(start.q.sum(), M_PI / 6.);
  EXPECT_DOUBLE_EQ(start.v.sum(), 4.);
  const auto signals = apps::scene_signals(scene, machine);
  EXPECT_EQ(signals[0].on_q, signals[1].on_q);
  EXPECT_EQ(signals[0].unit, "rad");
}

TEST_P(Named, TurnsInMeasuresJointsAndElements)
{
  const auto &[type, name] = GetParam();
  for (const std::string part :
       {"[measure.sum]\ntype = 'sum'\nterms = [{ of = '@' }, { of = 'other', factor = -2 }]\n",
        "[joint.drive]\ntype = 'prescribed motion'\non = '@'\nmotion = { speed = '60 1/min' }\n",
        "[element.spring]\ntype = 'spring-damper'\nfrom = '@'\nto = 'other'\nstiffness = '3 N m/rad'\n",
        "[element.spring]\ntype = 'spring-damper'\nfrom = 'other'\nto = '@'\nstiffness = '3 N m/rad'\n",
        "[element.spring]\ntype = 'spring-damper'\nfrom = '@'\nstiffness = '3 N m/rad'\n",
        "[element.motor]\ntype = 'asynchronous motor'\non = '@'\nbreakdown_torque = '9 N m'\nbreakdown_slip = 0.2\n"
        "synchronous_speed = '300 1/min'\n",
        "[modes]\nat = { '@' = '20 deg' }\n"})
    EXPECT_EQ(complaint(machine(type) + with_name(part, name)), "") << part;
}

TEST(TurningNames, AreRefusedWhereTheyMeanNoAngle)
{
  const std::string spring = "[element.spring]\ntype = 'spring-damper'\nfrom = 'crank.angle'\nstiffness = '3 N/m'\n";
  expect_complaint(machine("planar") + quoted(spring + "direction = [1, 0, 0]\n"), "names an angle");
  expect_complaint(machine("planar") + quoted("[start]\nq = { crank = 1, 'crank.angle' = 2 }\n"),
                   "already has a value");
  expect_complaint(machine("planar") + quoted("[start]\nq = { 'crank.displacement' = 1 }\n"),
                   "no coordinate 'crank.displacement'");
}

} // namespace
} // namespace gestell::tests
