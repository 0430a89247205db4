// Controlled steps where a motion begins from rest in directions that rounding alone moves, or has come to rest.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A bar whose centre is level with its pin: it falls along x = l cos(phi), whose change is rounding below 1e-8 rad.
const std::string level_bar =
    "gravity = [0, 0, -10]\n" + planar_body("bar", "2 kg", "0.1 kg m^2", "['0.5 m', 0, 0]") + "[run]\nend = '0.5 s'\n" +
    signals("phi = 'bar.angle', w = 'bar.speed'", {{"step", "0.1 s"}}) + revolute("pin", "ground", "bar", "[0, 0, 0]");

struct Company
{
  const char *name, *lines;
  double      compliance; ///< share by which the motion differs from that of the bar alone
};

std::ostream &operator<<(std::ostream &out, const Company &company)
{
  return out << company.name;
}

const Company companies[] = {
    {"alone", "", 0.},
    {"joint friction", "friction = { coefficient = 1e-9, radius = \"20 mm\" }\n", 1e-8},
    {"contact",
     "[element.floor]\ntype = \"contact\"\nfrom = \"bar\"\nto = \"ground\"\nat = [\"1 m\", 0, 0]\nnormal = [0, 0, 1]\n"
     "through = [0, 0, \"-2 m\"]\nstiffness = \"1e6 N/m\"\ndissipation = \"0.1 s/m\"\n",
     0.},
    // F/k of the 60 N at the pin, against the 0.5 m of the bar
    {"compliant pin", "stiffness = \"2e7 N/m\"\ndamping = \"2e3 N s/m\"\n", 1e-5}};

using LevelBar = ::testing::TestWithParam<Company>;

// Energy: (J + m l^2) w^2 / 2 = m g l sin(phi).
TEST_P(LevelBar, FallsFromRestInAFewStepsWhateverElseIsThere)
{
  for (const double tol : {1e-4, 1e-5, 1e-6})
  {
    const SceneRun motion = run(level_bar + GetParam().lines, {"run.tolerance=" + std::to_string(tol)});
    const double   phi = motion.signal("phi").final, w = motion.signal("w").final;
    EXPECT_GT(phi, 1.);
    EXPECT_NEAR(0.5 * (0.1 + 2. * 0.25) * w * w / (2. * 10. * 0.5 * std::sin(phi)), 1.,
                20. * tol + GetParam().compliance)
        << tol;
    EXPECT_LT(motion.result.work.steps, 2000) << tol;
  }
}

INSTANTIATE_TEST_SUITE_P(Companies, LevelBar, ::testing::ValuesIn(companies),
                         [](const auto &company) { return std::string(1, char('a' + company.index)); });

const std::string carriage =
    "gravity = [0, 0, -9.81]\n" + planar_body("carriage", "3 kg", "0.02 kg m^2", "[0, 0, 0]") +
    joint("guide", "prismatic", "ground", "carriage", "[0, 0, 0]",
          {{"axis", "[1, 0, 0]"},
           {"friction",
            "{ coefficient = 0.25, law = 'lugre', bristle_stiffness = '100 1/mm', bristle_damping = '1 s/m' }"}}) +
    start("v = { 'carriage.ux' = '1 m/s' }") + "[run]\nend = '0.2 s'\n" +
    signals("F = 'guide.friction', v = 'guide.sliding_speed', x = 'carriage.ux'");

// Bristles relaxed at the start bend within mu/(sigma_0 v) = 2.5 us; from then on Coulomb's law holds: v = v_0 - mu g
// t.
TEST(ControlledLuGre, StartsInTheMidstOfSliding)
{
  for (const double tol : {1e-3, 1e-4, 1e-5, 1e-6})
  {
    const SceneRun motion = run(carriage, {"run.tolerance=" + std::to_string(tol)});
    // Bending takes (sigma_1 v - mu) g for less than ten times these 2.5 us.
    EXPECT_NEAR(motion.signal("v").final, 1. - 0.25 * 9.81 * 0.2, 10. * tol + 10. * 2.5e-6 * 9.81) << tol;
    EXPECT_NEAR(motion.signal("F").final, -0.25 * 3. * 9.81, 1e-3) << tol;
    EXPECT_LT(motion.result.work.steps, 1000) << tol;
  }
}

const std::string box = "gravity = [0, 0, -9.81]\n" + planar_body("box", "3 kg", "0.02 kg m^2", "[0, 0, '0.1 m']") +
                        element("left", "contact",
                                {{"from", "box"},
                                 {"to", "ground"},
                                 {"at", "['-0.2 m', 0, 0]"},
                                 {"normal", "[0, 0, 1]"},
                                 {"stiffness", "1e6 N/m"},
                                 {"dissipation", "20 s/m"},
                                 {"friction", "{ coefficient = 0.3, speed = '0.1 mm/s' }"}}) +
                        element("right", "contact",
                                {{"from", "box"},
                                 {"to", "ground"},
                                 {"at", "['0.2 m', 0, 0]"},
                                 {"normal", "[0, 0, 1]"},
                                 {"stiffness", "1e6 N/m"},
                                 {"dissipation", "20 s/m"},
                                 {"friction", "{ coefficient = 0.3, speed = '0.1 mm/s' }"}}) +
                        R"([start]
q = { "box.uz" = "-14.715 um" }
v = { "box.ux" = "1 m/s" }
[run]
end = "1 s"
)" + signals("N = 'left.normal_force', x = 'box.ux'");

// It slides at first, and stops: Coulomb's law, v^2/(2 mu g), up to the last millimetre a second.
TEST(ControlledContact, ABodyThatComesToRestNeedsFewSteps)
{
  for (const double tol : {1e-3, 1e-4, 1e-6})
  {
    const SceneRun motion = run(box, {"run.tolerance=" + std::to_string(tol)});
    EXPECT_NEAR(motion.signal("N").final, 0.5 * 3. * 9.81, 1e-5) << tol;
    EXPECT_NEAR(motion.signal("x").final, 0.5 / (0.3 * 9.81), 1e-4) << tol; // it dips and tips by 15 um
    EXPECT_LT(motion.result.work.steps, 5000) << tol;
  }
}

} // namespace
} // namespace gestell::tests
