// Formulas that jump where a motion rests by friction: the value there is that of the formula at zero, for every
// method, and the mirror image of a scene gives the mirror image of its motion.

#include "coupling/integration/integration_methods.h"
#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// 1 kg at rest on a surface that holds 10 N and slides with 8 N, or the same turning, pushed by a formula.
std::string rubbing(const std::string &force, bool turns = false, const std::string &more = "")
{
  const std::string unit = turns ? " N m" : " N", on = turns ? "shaft" : "slide";
  return (turns ? rotor_body("shaft", "1", "[0, 0, 1]") : slider_body("slide", "1", "[1, 0, 0]")) +
         element("rub", "dry friction", {{"from", on}, {"static_force", "10" + unit}, {"kinetic_force", "8" + unit}}) +
         element("push", "formula force", {{"from", on}, {"force", force}}) + more + steps("1 ms", "0.1 s") +
         (turns ? signals("x = 'shaft.angle', v = 'shaft.speed', F = 'push.torque', R = 'rub.force'")
                : signals("x = 'slide.displacement', v = 'slide.velocity', F = 'push.force', R = 'rub.force'"));
}

const std::vector<Settings> formula_methods = {
    fixed, controlled, {"run.method=generalised-alpha", "run.rho_inf=0.8"}, {"run.method=exact"}};

struct Pushes
{
  std::string force, mirrored;
  double      at_rest; ///< [N] its value where nothing moves
};

/// The motion of the mirror image is minus that of the scene.
void expect_mirrored(const SceneRun &motion, const SceneRun &mirrored)
{
  for (const char *signal : {"x", "v", "F", "R"})
  {
    const auto  &a = motion.signal(signal), &b = mirrored.signal(signal);
    const double size = std::max({std::abs(a.min), std::abs(a.max), 1e-9});
    EXPECT_NEAR(a.min, -b.max, 1e-9 * size) << signal;
    EXPECT_NEAR(a.max, -b.min, 1e-9 * size) << signal;
    EXPECT_NEAR(a.final, -b.final, 1e-9 * size) << signal;
  }
  EXPECT_EQ(motion.result.events.size(), mirrored.result.events.size());
}

TEST(FormulaJump, HasItsValueAtZeroWhereFrictionHoldsTheMotion)
{
  for (const Pushes &push : {Pushes{"if(v > 0, 12 N, 9 N)", "if(v < 0, -12 N, -9 N)", 9.},
                             {"if(v >= 0, 9 N, 12 N)", "if(v <= 0, -9 N, -12 N)", 9.},
                             {"if(u < 0, 12 N, 9 N)", "if(u > 0, -12 N, -9 N)", 9.},
                             {"12 N*sign(v)", "12 N*sign(v)", 0.},
                             {"12 N*sign(u)*(1 + t/s) + 5 N", "12 N*sign(u)*(1 + t/s) - 5 N", 5.},
                             {"2 N + 15 N*step(-v)*sign(u)", "-2 N + 15 N*step(v)*sign(u)", 2.},
                             {"9 N - 1 N*abs(v)/(m/s)", "-9 N + 1 N*abs(v)/(m/s)", 9.},
                             {"if(v > 0, 12 N, if(v < 0, -12 N, 4 N))", "if(v < 0, -12 N, if(v > 0, 12 N, -4 N))", 4.}})
    for (const Settings &method : formula_methods)
    {
      SCOPED_TRACE(push.force + (method.empty() ? "" : ", " + method[0]));
      const SceneRun motion = run(rubbing(push.force), method), mirrored = run(rubbing(push.mirrored), method);
      expect_mirrored(motion, mirrored);
      EXPECT_TRUE(motion.result.events.empty());
      EXPECT_LT(std::max(std::abs(motion.signal("x").max), std::abs(motion.signal("x").min)), 1e-15);
      EXPECT_NEAR(motion.signal("F").min, push.at_rest, 1e-12);
      EXPECT_NEAR(motion.signal("F").max, push.at_rest, 1e-12);
      EXPECT_NEAR(motion.signal("R").final, push.at_rest, 1e-12);
    }
}

TEST(FormulaJump, LeavesZeroWithTheMotion)
{
  // 12 N break away at once, 20 N push from then on.
  for (const Pushes &push : {Pushes{"if(v > 0, 20 N, 12 N)", "if(v < 0, -20 N, -12 N)", 12.},
                             {"12 N + 8 N*sign(v)", "-12 N + 8 N*sign(v)", 12.},
                             {"12 N + 8 N*sign(u)", "-12 N + 8 N*sign(u)", 12.}})
    for (const Settings &method : formula_methods)
    {
      SCOPED_TRACE(push.force + (method.empty() ? "" : ", " + method[0]));
      const SceneRun motion = run(rubbing(push.force), method), mirrored = run(rubbing(push.mirrored), method);
      expect_mirrored(motion, mirrored);
      EXPECT_NEAR(motion.signal("v").final, 0.1 * (20. - 8.), 1e-7); // v = t (F - R)/m
    }
}

TEST(FormulaJump, AboutAnAxisAndFromATimeOn)
{
  for (const Settings &method : formula_methods)
  {
    const SceneRun motion   = run(rubbing("if(v > 0, 12 N m, 9 N m)", true), method),
                   mirrored = run(rubbing("if(v < 0, -12 N m, -9 N m)", true), method);
    expect_mirrored(motion, mirrored);
    EXPECT_EQ(motion.signal("F").max, 9.);
    // From 50 ms on it slides by 12 N - 8 N.
    const SceneRun timed = run(rubbing("if(v > 0, 12 N, if(t < 50 ms, 9 N, 11 N))"), method);
    EXPECT_NEAR(timed.signal("v").final, 0.05 * (12. - 8.), 1e-7);
  }
}

/// It comes to rest from either side, and the formula has its value at zero there.
TEST(FormulaJump, ComesToRestOnItsZero)
{
  const std::string push = "-3 N*sign(v) + if(v < 0, -2 N, 1 N)", mirrored_push = "-3 N*sign(v) + if(v > 0, 2 N, -1 N)";
  for (const Settings &method : formula_methods)
  {
    SCOPED_TRACE(method.empty() ? "" : method[0]);
    const SceneRun motion   = run(rubbing(push, false, start("v = { slide = '0.5 m/s' }")), method),
                   mirrored = run(rubbing(mirrored_push, false, start("v = { slide = '-0.5 m/s' }")), method);
    expect_mirrored(motion, mirrored);
    EXPECT_NEAR(time_of(motion, "stick"), 0.5 / (8. + 3. - 1.), 1e-8);
    EXPECT_NEAR(motion.signal("F").final, 1., 1e-12);
    EXPECT_NEAR(motion.signal("R").final, 1., 1e-9);
  }
}

/// Friction by a formula beside one that sticks: 14 N are less than the 18 N of both, and neither lets it creep.
TEST(FormulaJump, ThatBrakesBesideFrictionLetsItRest)
{
  for (const char *start_at : {"0 m/s", "0.1 m/s"})
    for (const Settings &method : formula_methods)
    {
      SCOPED_TRACE(std::string(start_at) + (method.empty() ? "" : ", " + method[0]));
      const std::string begin  = start("v = { slide = '" + std::string(start_at) + "' }");
      const SceneRun    motion = run(rubbing("14 N - 8 N*sign(v)", false, begin), method);
      EXPECT_LT(motion.result.events.size(), 10u);
      EXPECT_EQ(motion.result.work.chatter, 0);
      EXPECT_LT(std::abs(motion.signal("v").final), 1e-12);
    }
}

} // namespace
} // namespace gestell::tests
