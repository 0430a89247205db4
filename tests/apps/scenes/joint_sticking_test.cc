// Ideal joints that stick: events, rest, limits and energy by hand.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::with;

// --- a carriage on an inclined guide: tan(a) = 0.4

const std::string sticking_incline =
    "gravity = [0, 0, -10]\n[parameters]\na = 'atan(0.4)'\n" +
    planar_body("carriage", "3 kg", "0.02 kg m^2", "[0, 0, 0]") +
    joint("guide", "prismatic", "ground", "carriage", "[0, 0, 0]",
          {{"axis", "['cos(a)', 0, '-sin(a)']"}, {"friction", "{ law = 'dry', coefficient = 0.3, static = 0.5 }"}}) +
    steps("1 ms", "0.5 s") +
    signals(
        "x = 'carriage.ux', z = 'carriage.uz', F = 'guide.friction', v = 'guide.sliding_speed', N = 'guide.resultant'");
const double   a = std::atan(0.4), weight = 30.;
const Settings newmark = {"run.method=generalised-alpha", "run.rho_inf=0.8"};

TEST(StickingGuide, HoldsABlockWhoseSlopeIsBelowTheStaticCoefficientExactly)
{
  const SceneRun motion = run(sticking_incline);
  // Exactly, but for what rounding leaves where the guide is closed.
  EXPECT_LT(std::abs(motion.signal("x").max) + std::abs(motion.signal("x").min), 1e-18);
  EXPECT_LT(std::abs(motion.signal("v").max) + std::abs(motion.signal("v").min), 1e-15);
  EXPECT_TRUE(motion.result.events.empty());
  EXPECT_NEAR(motion.signal("F").min, -weight * std::sin(a), 1e-10);
  EXPECT_NEAR(motion.signal("F").max, -weight * std::sin(a), 1e-10);
  EXPECT_NEAR(motion.signal("N").final, weight * std::cos(a), 1e-10);
}

TEST(StickingGuide, ReleasesAtOnceWhereTheSlopeIsSteeper)
{
  const SceneRun motion = run(with(sticking_incline, "static = 0.5", "static = 0.35"));
  ASSERT_EQ(motion.result.events.size(), 1u);
  EXPECT_EQ(time_of(motion, "slip_forward"), 0.);
  EXPECT_NEAR(motion.signal("v").final, 0.5 * 10. * (std::sin(a) - 0.3 * std::cos(a)), 1e-10);
  // What would hold it, 30 sin(a), never acts: neither in the first row nor in the extremes.
  const double slides = 0.3 * weight * std::cos(a);
  EXPECT_NEAR(motion.at(0, 3), -slides, 1e-10);
  EXPECT_NEAR(motion.signal("F").min, -slides, 1e-10);
  EXPECT_NEAR(motion.signal("F").max, -slides, 1e-10);
}

/// A pull that jumps from 0 to 40 N at 0.1 s: until then it holds 30 sin(a), from then on it slides.
TEST(StickingGuide, NeverReportsAForceBeyondItsLimitWhereTheLoadJumps)
{
  const SceneRun motion = run(sticking_incline + element("pull", "table force",
                                                         {{"from", "carriage"},
                                                          {"direction", "['cos(a)', 0, '-sin(a)']"},
                                                          {"against", "time"},
                                                          {"table", "[[0, 0], ['0.1 s', 0], ['0.1 s', '40 N']]"}}));
  EXPECT_NEAR(time_of(motion, "slip_forward"), 0.1, 1e-12);
  EXPECT_NEAR(motion.at(0, 3), -weight * std::sin(a), 1e-10);
  EXPECT_NEAR(motion.signal("F").min, -weight * std::sin(a), 1e-10);
  EXPECT_NEAR(motion.signal("F").max, -0.3 * weight * std::cos(a), 1e-10);
}

/// Thrown up the slope with v_0 it stops after v_0/(g (sin a + mu cos a)), and stays: mu < tan a < mu_s.
TEST(StickingGuide, StopsABlockThrownUpTheSlopeThatThenStaysThere)
{
  const std::string thrown = sticking_incline + start("v = { 'carriage.ux' = '-2 m/s * cos(a)' }");
  for (const auto &[method, error] : {std::pair{fixed, 1e-9}, {newmark, 1e-9}, {controlled, 1e-7}})
  {
    const SceneRun motion = run(thrown, method);
    const double   brake = 10. * (std::sin(a) + 0.3 * std::cos(a)), way = 2. * 2. / (2. * brake);
    EXPECT_EQ(count(motion, "slip_forward"), 0);
    EXPECT_EQ(count(motion, "stick"), 1);
    EXPECT_NEAR(time_of(motion, "stick"), 2. / brake, error);
    EXPECT_NEAR(motion.signal("x").final, -way * std::cos(a), error);
    EXPECT_NEAR(motion.signal("z").final, way * std::sin(a), error);
    EXPECT_NEAR(motion.signal("F").final, -weight * std::sin(a), 10. * error);
    EXPECT_NEAR(motion.result.energy.dissipated, 0.3 * weight * std::cos(a) * way, 10. * error);
    expect_closed_balance(motion, error);
  }
}

/// A force that grows along the slope: break-away where it and the weight reach mu_s N.
TEST(StickingGuide, BreaksAwayWhereTheForceReachesTheLimitOfItsOwnLoad)
{
  // Pressed with 1 s^-1 t 12 N into the slope besides: the limit grows too.
  const std::string pulled =
      sticking_incline +
      element("pull", "formula force",
              {{"from", "carriage"}, {"direction", "['cos(a)', 0, '-sin(a)']"}, {"force", "40 N/s*t"}}) +
      element("press", "formula force",
              {{"from", "carriage"}, {"direction", "['-sin(a)', 0, '-cos(a)']"}, {"force", "12 N/s*t"}});
  // 30 sin a + 40 t = 0.5 (30 cos a + 12 t)
  const double t = 30. * (0.5 * std::cos(a) - std::sin(a)) / (40. - 6.);
  for (const auto &[method, error] : {std::pair{fixed, 1e-11}, {controlled, 1e-7}})
  {
    const SceneRun motion = run(pulled, method);
    EXPECT_NEAR(time_of(motion, "slip_forward"), t, error);
    EXPECT_EQ(motion.result.events.size(), 1u);
  }
}

// --- a pendulum whose pin sticks

const std::string sticking_pendulum =
    "gravity = [0, 0, -10]\n" + planar_body("bar", "2 kg", "0.1 kg m^2", "[0, 0, '-0.5 m']") +
    revolute("pin", "ground", "bar", "[0, 0, 0]",
             {{"friction", "{ law = 'dry', coefficient = 0.3, static = 0.4, radius = '150 mm' }"}}) +
    start("q = { 'bar.angle' = 0.8 }") + steps("0.5 ms", "5 s") +
    signals("angle = 'bar.angle', M = 'pin.friction', N = 'pin.resultant', w = 'bar.speed'", {{"step", "5 ms"}});

TEST(StickingPin, APendulumComesToRestOffTheVerticalAndStays)
{
  const SceneRun motion = run(sticking_pendulum);
  const double   rest   = motion.signal("angle").final;
  EXPECT_GT(std::abs(rest), 1e-3);
  // Held by the moment of its weight, which the pin can hold: r mu_s m g.
  EXPECT_NEAR(motion.signal("M").final, 2. * 10. * 0.5 * std::sin(rest), 1e-9);
  EXPECT_LT(std::abs(motion.signal("M").final), 0.15 * 0.4 * 20.);
  EXPECT_NEAR(motion.signal("N").final, 20., 1e-9);
  // At rest from the last stick on, but for rounding where the pin is closed: a few eps of half a metre.
  EXPECT_LT(std::abs(motion.signal("w").final), 1e-12);
  double last = 0.;
  for (const auto &event : motion.result.events)
    last = event.t;
  EXPECT_LT(last, 4.);
  int resting = 0;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
    if (motion.at(i, 0) > last)
      resting += std::abs(motion.at(i, 1) - rest) < 1e-14 ? 1 : -1000;
  EXPECT_GT(resting, 100);
  // What it lost is what the pin took: m g l (cos(rest) - cos(0.8)).
  const double lost = 2. * 10. * 0.5 * (std::cos(rest) - std::cos(0.8));
  EXPECT_NEAR(motion.result.energy.dissipated, lost, 1e-4 * lost);
  expect_closed_balance(motion, 1e-4);
}

// --- several joints that hold one motion

/// Two carriages of 3 kg and 2 kg on a level, a rod between them.
std::string train(const std::string &rest)
{
  const Keys rubs = {{"axis", "[1, 0, 0]"}, {"friction", "{ law = 'dry', coefficient = 0.2, static = 0.5 }"}};
  return "gravity = [0, 0, -10]\n" + planar_body("one", "3 kg", "0.02 kg m^2", "[0, 0, 0]") +
         joint("guide_one", "prismatic", "ground", "one", "[0, 0, 0]", rubs) +
         planar_body("two", "2 kg", "0.02 kg m^2", "[1, 0, 0]") +
         joint("guide_two", "prismatic", "ground", "two", "[1, 0, 0]", rubs) +
         joint("rod", "distance", {{"from", "one"}, {"to", "two"}}) + steps("1 ms", "1 s") +
         signals("x = 'two.ux', v = 'two.vx', F1 = 'guide_one.friction', F2 = 'guide_two.friction'") + rest;
}

TEST(StickingJoints, ThatHoldOneMotionComeToRestTogether)
{
  const SceneRun motion = run(train(start("v = { 'two.ux' = 1 }")));
  ASSERT_EQ(motion.result.events.size(), 1u); // the first one holds both
  EXPECT_NEAR(time_of(motion, "stick"), 1. / 2., 1e-9);
  EXPECT_NEAR(motion.signal("x").final, 0.25, 1e-9);
  EXPECT_LT(std::abs(motion.signal("v").final), 1e-12); // rounding of the rod's 1 m within a step: 2e-16 m/1 ms
  EXPECT_NEAR(motion.signal("F1").final + motion.signal("F2").final, 0., 1e-9); // nothing pulls
  expect_closed_balance(motion, 1e-9);
}

// One after the other reaches its limit: 15 N of the first, then 6 N + 10 N with the first sliding.
TEST(StickingJoints, ThatHoldOneMotionReleaseOneAfterTheOther)
{
  const SceneRun motion = run(
      train(element("pull", "formula force", {{"from", "two"}, {"direction", "[1, 0, 0]"}, {"force", "20 N/s*t"}})));
  ASSERT_EQ(motion.result.events.size(), 2u);
  EXPECT_NEAR(time_of(motion, "slip_forward", 0), 15. / 20., 1e-9);
  EXPECT_NEAR(time_of(motion, "slip_forward", 1), 16. / 20., 1e-9);
  // 5 v = int 20 t - 10 from 0.8 s to 1 s
  EXPECT_NEAR(motion.signal("v").final, (10. * (1. - 0.64) - 10. * 0.2) / 5., 1e-5);
}

// What a drive moves cannot stick: at its dead points it turns, and the friction with it.
TEST(StickingJoints, ThatAreDrivenTurnAtTheirDeadPoints)
{
  const SceneRun motion =
      run(sticking_incline + joint("drive", "prescribed motion",
                                   {{"on", "carriage.ux"}, {"motion", "{ function = '0.1 m*sin(10 rad/s*t)' }"}}),
          {"parameters.a=0", "output.signals.P=drive.force", "run.end=1 s"});
  EXPECT_EQ(count(motion, "stick"), 3);
  for (int n = 0; n < 3; ++n)
    EXPECT_NEAR(time_of(motion, "stick", n), (0.5 + n) * M_PI / 10., 1e-6);
  EXPECT_NEAR(motion.signal("F").max, 9., 1e-9);
  EXPECT_NEAR(motion.signal("F").min, -9., 1e-9);
  EXPECT_NEAR(motion.signal("P").final, 9. * (std::cos(10.) > 0. ? 1. : -1.) - 3. * 10. * std::sin(10.), 1e-6);
  EXPECT_NEAR(motion.result.energy.dissipated, 0.9 * (6. + std::abs(std::sin(10.))), 1e-3);
}

/// A slider-crank whose four joints all stick: left to itself, it comes to rest.
TEST(StickingJoints, OfASliderCrankBringItToRest)
{
  const SceneRun motion =
      run("gravity = [0, 0, -10]\n" + planar_body("crank", "2 kg", "0.05 kg m^2", "['0.05 m', 0, 0]") +
          planar_body("rod", "1 kg", "0.02 kg m^2", "['0.35 m', 0, 0]") +
          planar_body("ram", "2 kg", "0.01 kg m^2", "['0.6 m', 0, 0]") +
          revolute("bearing", "ground", "crank", "[0, 0, 0]",
                   {{"friction", "{ law = 'dry', coefficient = 0.1, static = 0.15, radius = '20 mm' }"}}) +
          revolute("pin", "crank", "rod", "['0.1 m', 0, 0]",
                   {{"friction", "{ law = 'dry', coefficient = 0.1, static = 0.15, radius = '20 mm' }"}}) +
          revolute("wrist", "rod", "ram", "['0.6 m', 0, 0]",
                   {{"friction", "{ law = 'dry', coefficient = 0.1, static = 0.15, radius = '15 mm' }"}}) +
          joint("guide", "prismatic", "ground", "ram", "['0.6 m', 0, 0]",
                {{"axis", "[1, 0, 0]"}, {"friction", "{ law = 'dry', coefficient = 0.1, static = 0.15 }"}}) +
          start("v = { 'crank.angle' = 12 }") + steps("0.5 ms", "7 s") +
          signals("angle = 'crank.angle', w = 'crank.speed', M = 'bearing.friction', F = 'guide.friction'",
                  {{"step", "10 ms"}}));
  double last = 0.;
  for (const auto &event : motion.result.events)
    last = std::max(last, event.t);
  EXPECT_LT(last, 6.5);
  EXPECT_LT(motion.result.events.size(), 200u);
  const double rest    = motion.signal("angle").final;
  int          resting = 0;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
    if (motion.at(i, 0) > last)
      resting += std::abs(motion.at(i, 1) - rest) < 1e-9 ? 1 : -1000;
  EXPECT_GT(resting, 40);
  EXPECT_GT(rest, 1.);
  expect_closed_balance(motion, 1e-4);
}

// --- bristles

/// Pulled on monotonically they give way by  x = -mu/sigma_0 ln(1 - F/(mu N)),  from  dF/dx = sigma_0 (N - F/mu).
TEST(BristlesInJoints, GiveWayElasticallyBelowTheLimit)
{
  const std::string bristles =
      with(sticking_incline, "law = 'dry', coefficient = 0.3, static = 0.5",
           "law = 'lugre', coefficient = 0.5, bristle_stiffness = '1 1/mm', bristle_damping = '100 s/m'");
  const SceneRun motion = run(bristles, {"run.end=4 s", "run.step=2 ms"});
  const double   x      = -0.5 / 1000. * std::log(1. - 0.4 / 0.5);
  EXPECT_NEAR(motion.signal("x").final, x * std::cos(a), 1e-4 * x);
  EXPECT_NEAR(motion.signal("F").final, -weight * std::sin(a), 1e-8);
}

TEST(BristlesInJoints, SlideWithTheKineticCoefficientAboveIt)
{
  const std::string bristles =
      with(sticking_incline, "law = 'dry', coefficient = 0.3, static = 0.5",
           "law = 'lugre', coefficient = 0.2, bristle_stiffness = '1 1/mm', bristle_damping = '10 s/m'");
  const SceneRun at_1 = run(bristles, {"run.end=1 s"}), at_2 = run(bristles, {"run.end=2 s"});
  EXPECT_NEAR(at_2.signal("F").final, -0.2 * weight * std::cos(a), 1e-8);
  EXPECT_NEAR(at_2.signal("v").final - at_1.signal("v").final, 10. * (std::sin(a) - 0.2 * std::cos(a)), 1e-8);
}

TEST(BristlesInJoints, OfAPinSlideAtItsRadius)
{
  const std::string pin =
      with(with(sticking_pendulum, "-0.5 m", "0 m"), "law = 'dry', coefficient = 0.3, static = 0.4",
           "law = 'lugre', coefficient = 0.3, bristle_stiffness = '1 1/mm', bristle_damping = '100 s/m'");
  const SceneRun motion =
      run(pin + element("pull", "force", {{"from", "bar"}, {"about", "[0, 1, 0]"}, {"constant", "0.6 N m"}}),
          {"start.q={}", "run.end=4 s", "run.step=2 ms"});
  const double angle = -0.3 / 1000. / 0.15 * std::log(1. - 0.6 / (0.15 * 0.3 * 20.));
  EXPECT_NEAR(motion.signal("angle").final, angle, 1e-4 * angle);
  EXPECT_NEAR(motion.signal("M").final, -0.6, 1e-7);
}

// What bristles store counts as dissipated; the balance is left open by the error of the method alone.
TEST(BristlesInJoints, CloseTheBalanceOfEnergyAtTheOrderOfTheMethod)
{
  const std::string swings =
      with(sticking_pendulum, "law = \"dry\", coefficient = 0.3, static = 0.4, radius = \"150 mm\"",
           "law = \"lugre\", coefficient = 0.3, static = 0.4, stribeck_speed = \"10 mm/s\", radius = \"20 mm\", "
           "bristle_stiffness = \"10 1/mm\", bristle_damping = \"10 s/m\"");
  const auto lack = [&](const std::string &step)
  {
    const SceneRun motion = run(swings, {"run.step=" + step, "run.end=4 s"});
    EXPECT_GT(motion.result.energy.dissipated, 1.);
    return std::abs(motion.result.energy.residual) / motion.result.energy.dissipated;
  };
  const double coarse = lack("2 ms"), fine = lack("0.5 ms");
  EXPECT_LT(fine, 1e-5);
  EXPECT_LT(fine, coarse / 8.); // of second order 16
}

TEST(StickingJoints, RefuseWhatMakesNoSense)
{
  EXPECT_EQ(test::complaint(sticking_incline), "");
  expect_complaint(with(sticking_incline, "static = 0.5", "static = 0.2"), "is below 'coefficient'");
  expect_complaint(with(sticking_incline, "law = \"dry\"", "law = \"drier\""), "dry");
  expect_complaint(with(sticking_incline, "static = 0.5", "speed = \"1 mm/s\""), "speed");
  expect_complaint(with(sticking_incline, "type = \"prismatic\"", "type = \"in-plane\""), "remove it");
  expect_complaint(with(sticking_incline, "law = \"dry\"", "law = \"lugre\""), "bristle_stiffness");
  expect_complaint(with(sticking_incline, "law = \"dry\"", "law = \"lugre\", bristle_stiffness = \"1 1/mm\""),
                   "needs 'stribeck_speed'");
  expect_complaint(with(sticking_pendulum, ", radius = \"150 mm\"", ""), "the key 'radius' is missing");
}

// What turns with both bodies cannot be held: told when the machine is built.
TEST(StickingJoints, RefuseWhatTheyCannotHold)
{
  const auto refused = [](const std::string &scene, const std::string &words)
  { expect_refusal([&] { run(scene); }, words); };
  refused(
      with(sticking_incline + planar_body("arm", "1 kg", "1 kg m^2", "[0, 0, 0]"), "from = 'ground'", "from = 'arm'"),
      "here both bodies rotate");
  refused("gravity = [0, 0, -10]\n" + rigid_body("bar", "2 kg", "[0.1, 0.1, 0.01]", "[0, 0, -0.5]") +
              revolute("pin", "ground", "bar", "[0, 0, 0]",
                       {{"axis", "[0, 1, 0]"}, {"friction", "{ law = 'dry', coefficient = 0.3, radius = '150 mm' }"}}) +
              steps("0.5 ms", "5 s"),
          "free spatial body");
}

} // namespace
} // namespace gestell::tests
