// Drives, motors, brakes and clutches: from the scene to the motion, against solutions by hand.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;

using Drives = ::testing::TestWithParam<Settings>;
INSTANTIATE_TEST_SUITE_P(Methods, Drives, ::testing::Values(fixed, controlled));

// --- speed drive

const std::string controller = element(
    "drive", "speed drive",
    {{"on", "shaft"}, {"proportional_gain", "10 N m s/rad"}, {"integral_gain", "20 N m/rad"}, {"speed", "30 rad/s"}});

TEST_P(Drives, WithSpeedControlRunUpLikeTheLinearSystem)
{
  // J e'' + k_p e' + k_i e = 0 with e(0) = 30 rad/s, e'(0) = -k_p e(0)/J.
  const double   J = 2., delta = 10. / (2. * J), omega = std::sqrt(20. / J - delta * delta), t = 0.8;
  const SceneRun motion =
      run(rotor(J, "0.8 s") + "T = \"drive.torque\"\nI = \"drive.integral\"\n" + controller, GetParam());
  const double slope = (-150. + delta * 30.) / omega; // of the sine's factor
  const double error = std::exp(-delta * t) * (30. * std::cos(omega * t) + slope * std::sin(omega * t));
  const double rate =
      -delta * error + std::exp(-delta * t) * omega * (slope * std::cos(omega * t) - 30. * std::sin(omega * t));
  EXPECT_NEAR(motion.signal("w").final, 30. - error, 2e-5);
  EXPECT_NEAR(motion.signal("T").final, -J * rate, 2e-4);
  EXPECT_NEAR(motion.signal("I").final, -J * rate - 10. * error, 2e-4);
  EXPECT_NEAR(motion.result.energy.input, 0.5 * J * std::pow(30. - error, 2), 0.02); // and nothing of the controller
  expect_closed_balance(motion, 1e-5);
}

TEST_P(Drives, LeaveTheLimitOfTheirTorqueWithoutWindingUp)
{
  const double   J = 2., M = 50., T = 0.5;
  const SceneRun motion =
      run(rotor(J, "6 s") + "T = \"drive.torque\"\n" + controller + "largest_torque = \"50 N m\"\n", GetParam());
  double low = 0., high = 2.; // k_p (30 - M t/J) + M (1 - exp(-t/T)) = M
  for (int i = 0; i < 60; ++i)
  {
    const double t                                                = 0.5 * (low + high);
    (10. * (30. - M * t / J) > M * std::exp(-t / T) ? low : high) = t;
  }
  EXPECT_NEAR(time_of(motion, "limit_left"), low, 1e-5);
  EXPECT_NEAR(motion.signal("T").max, M, 1e-9);
  EXPECT_NEAR(motion.signal("w").final, 30., 1e-4);
  EXPECT_EQ(count(motion, "limit_left"), 1); // it does not come back
}

TEST_P(Drives, FollowRampsWithoutAJerk)
{
  // 12 rad/s in 3.5 s; a PI control follows a constant acceleration with the error J a'/k_i = 0 and loses J j/k_i.
  const SceneRun motion = run(
      rotor(2., "5 s") + "wanted = 'drive.wanted_speed'\n" +
          element("drive", "speed drive",
                  {{"on", "shaft"},
                   {"proportional_gain", "200 N m s/rad"},
                   {"integral_gain", "4000 N m/rad"},
                   {"speed", "[{ at = '0.5 s', to = '12 rad/s', acceleration = '4 rad/s^2', jerk = '8 rad/s^3' }]"}}),
      GetParam());
  ASSERT_EQ(count(motion, "next_segment"), 4);
  EXPECT_NEAR(time_of(motion, "next_segment", 0), 0.5, 1e-12);
  EXPECT_NEAR(time_of(motion, "next_segment", 3), 4., 1e-12);
  EXPECT_EQ(motion.signal("wanted").max, 12.);
  EXPECT_NEAR(motion.signal("w").final, 12., 1e-6);
  // The angle lags by the integral of the error, which is that of the torque: none in the end.
  EXPECT_NEAR(motion.signal("phi").final, 12. * (0.5 * 3.5 + 1.), 2e-5);
}

// --- dynamic motor

const std::string motor = element("motor", "dynamic motor",
                                  {{"on", "shaft"},
                                   {"breakdown_torque", "240 N m"},
                                   {"breakdown_slip", "0.15"},
                                   {"synchronous_speed", "157 rad/s"},
                                   {"time_constant", "20 ms"}}) +
                          start("v = { shaft = 150 }");

TEST_P(Drives, WithADynamicCharacteristicBuildUpTheirTorqueWithALag)
{
  const SceneRun motion = run(rotor(1e9, "50 ms") + "T = \"motor.torque\"\n" + motor, GetParam());
  const double   slip = 1. - 150. / 157., stationary = 2. * 240. * slip * 0.15 / (slip * slip + 0.15 * 0.15);
  EXPECT_NEAR(motion.signal("T").final, stationary * (1. - std::exp(-2.5)), 1e-4 * stationary);
  const double impulse = stationary * (0.05 - 0.02 * (1. - std::exp(-2.5)));
  EXPECT_NEAR(motion.result.energy.input, 150. * impulse, 1e-4 * 150. * impulse);
}

TEST_P(Drives, WithADynamicCharacteristicVibrateAgainstTheirRotor)
{
  // Near synchronism T J w'' + J w' + k w = 0, k = 2 M_K/(s_K Omega): frequency by the electrical time constant.
  const double   J = 0.2, T = 0.02, k = 2. * 240. / (0.15 * 157.);
  const double   delta = 0.5 / T, omega = std::sqrt(k / (J * T) - delta * delta), t = 0.1;
  const Settings start    = {"start.v.shaft=156.99", "run.step=0.02 ms"};
  Settings       settings = GetParam();
  settings.insert(settings.end(), start.begin(), start.end());
  const SceneRun motion = run(rotor(J, "0.1 s") + motor, settings);
  const double   e      = std::exp(-delta * t) * 0.01 * (std::cos(omega * t) + delta / omega * std::sin(omega * t));
  EXPECT_NEAR(motion.signal("w").final, 157. - e, 2e-5 * 0.01 + 1e-7);
}

TEST(DynamicMotor, StartsSteadilyWithItsStationaryTorque)
{
  const SceneRun motion =
      run(rotor(3., "20 ms") + "T = \"motor.torque\"\nS = \"motor.stationary_torque\"\n" + motor,
          {"start={ rule = \"steady\", angles = { shaft = 0 }, speeds = { shaft = 150 }, driver = \"shaft\" }",
           "element.load={ type = \"force profile\", from = \"shaft\", profile = -100 }"});
  EXPECT_NEAR(motion.signal("T").max, motion.signal("S").max, 1e-2);
  EXPECT_GT(motion.signal("T").min, 100.);
}

TEST(DynamicMotor, IsRefusedByMethodsThatNeedMass)
{
  for (const std::string method : {"newmark", "hht", "exact", "central-difference"})
    expect_refusal([&] { run(rotor(3., "20 ms") + motor, {"run.method=" + method}); }, "motor.torque");
}

// The press of the reference, its frame by matrices: a motor that follows at once is the stationary one.
TEST(DynamicMotor, WithAShortTimeConstantIsTheStationaryOne)
{
  const SceneRun stationary("press_minimal.toml");
  const SceneRun dynamic("press_minimal.toml",
                         {"element.motor.type=dynamic motor", "element.motor.time_constant=1 us"});
  EXPECT_EQ(dynamic.n, stationary.n + 1);
  EXPECT_NEAR(dynamic.signal("F_P").max, stationary.signal("F_P").max, 1e-6 * stationary.signal("F_P").max);
  EXPECT_NEAR(dynamic.signal("M_mot").max, stationary.signal("M_mot").max, 1e-4 * stationary.signal("M_mot").max);
  EXPECT_NEAR(dynamic.result.energy.input, stationary.result.energy.input, 1e-5 * stationary.result.energy.input);
}

// Beside modal coordinates, which every step condenses.
TEST(DynamicMotor, RunsBesideAFrameOfModes)
{
  const SceneRun motion("benchmark/m20.toml", {"body.shaft={ type = \"rotor\", axis = [0, 0, 1], inertia = 1e9 }",
                                               "element.motor={ type = \"dynamic motor\", on = \"shaft\", "
                                               "breakdown_torque = 240, breakdown_slip = 0.15, synchronous_speed = "
                                               "157, time_constant = \"20 ms\" }",
                                               "output.signals.T=motor.torque", "run.end=20 ms", "run.step=20 us"});
  EXPECT_NEAR(motion.signal("T").final, 2. * 240. * 0.15 / (1. + 0.0225) * (1. - std::exp(-1.)), 1e-3);
}

// --- documentation

TEST(SceneReference, ItsExamplesOfElementsAreRead)
{
  std::ifstream     in(std::string(GESTELL_SOURCE_DIR) + "/docs/reference/scene/elements.md");
  const std::string document{std::istreambuf_iterator<char>(in), {}};
  const auto        begin = document.find("```toml\n", document.find("## Examples")) + 8;
  ASSERT_GT(begin, 8u);
  std::string scene = document.substr(begin, document.find("```", begin) - begin);
  for (const std::string body : {"crank", "flywheel", "rod", "lance"})
    scene += rotor_body(body, "3", "[0, 1, 0]");
  for (const std::string body : {"load", "spindle", "slide", "piston", "bead"})
    scene += slider_body(body, "3", "[0, 0, 1]");
  EXPECT_EQ(complaint(scene + R"([frame]
mass      = [[1, 0], [0, 1]]
stiffness = [[1, 0], [0, 1]]
[frame.interface.jib]
rows = { uz = 1 }
[frame.interface.bearing]
rows = { ux = 2 }
)" + steps("1 ms", "1 s") +
                      signals("w = 'crank.speed'")),
            "");
}

TEST(Lag, NeedsATimeConstant)
{
  coupling::MachineModel machine;
  EXPECT_THROW(machine.add_lag("motor.torque", 0.), std::invalid_argument);
  EXPECT_EQ(machine.add_lag("motor.torque", 1e-3), 0);
}

TEST(DynamicMotor, RefusesWhatMakesNoSense)
{
  const std::string scene = rotor(3., "20 ms") + motor;
  EXPECT_EQ(complaint(scene), "");
  expect_complaint(scene, "needs either 'time_constant'", {"element.motor.mains_frequency=50 Hz"});
  expect_complaint(scene, "needs a time above zero", {"element.motor.time_constant=0"});
  expect_complaint(scene, "needs a time", {"element.motor.time_constant=1 m"});
}

// --- profiles

TEST_P(Drives, ByATorqueProfileGetItsImpulse)
{
  // S-curve over 10 N m in 2.5 s: 12.5 N m s; then 10 N m for 1 s.
  const SceneRun motion = run(
      rotor(2., "4 s") +
          element("push", "force profile",
                  {{"from", "shaft"},
                   {"profile", "[{ at = '0.5 s', to = '10 N m', rate = '5 N m/s', rate_of_rate = '10 N m/s^2' }]"}}),
      GetParam());
  EXPECT_NEAR(motion.signal("w").final, 22.5 / 2., 1e-6);
  EXPECT_EQ(count(motion, "next_segment"), 4);
}

TEST(Profiles, RefuseWhatMakesNoSense)
{
  const auto scene = [](const std::string &profile)
  { return rotor(2., "4 s") + "[element.push]\ntype = \"force profile\"\nfrom = \"shaft\"\nprofile = " + profile; };
  EXPECT_EQ(complaint(scene("[{ at = \"1 s\", to = 5 }]")), "");
  expect_complaint(scene("[]"), "is an empty array");
  expect_complaint(scene("[{ at = \"1 s\", to = \"5 N\" }]"), "needs a torque");
  expect_complaint(scene("[{ at = \"1 s\", to = 5, rate = 0 }]"), "above zero");
  expect_complaint(scene("[{ at = \"1 s\", to = 5, rate = 1 }, { at = \"2 s\", to = 0 }]"),
                   "ramp 2, begin [s] = 2, but it must be 6 s (end of the previous ramp)");
  expect_complaint(scene("[{ at = \"1 s\", to = 5, slope = 1 }]"), "slope");
}

TEST(Inputs, StayAtTheInitialLevelOfARun)
{
  const auto push = [](const std::string &profile) {
    return element("push", "force profile", {{"from", "shaft"}, {"initial", "10 N m"}, {"profile", profile}});
  };
  const SceneRun motion = run(rotor(2., "4 s") + push("{ input = 'M' }"));
  EXPECT_NEAR(motion.signal("w").final, 10. / 2. * 4., 1e-6);
  const std::string stop  = "[switch.stop]\nwhen = \"shaft.speed\"\nabove = 1\ntell = \"push\"\norder = \"hold\"\n";
  const std::string scene = rotor(2., "4 s");
  expect_complaint(scene + push("{ input = 'M' }") + stop, "hold");
  expect_complaint(scene + push("{ input = 'a<b' }"), "an input needs a name");
  expect_complaint(scene + push("{ input = 'M', period = '1 s' }"), "remove 'period' or 'input'");
  expect_complaint(scene + push("{ input = 'M' }") + "waits = true\n", "has no effect on an input");
}

// --- brake and clutch

const std::string brake =
    element("load", "force", {{"from", "shaft"}, {"constant", "3 N m"}}) +
    element("brake", "brake",
            {{"from", "shaft"},
             {"capacity", "5 N m"},
             {"engagement", "[{ at = '0.1 s', to = 1, rate = '5/s' }, { at = '11 s', to = 0 }]"}}) +
    start("v = { shaft = 10 }");

TEST_P(Drives, AreStoppedByABrakeAndHeldUntilItIsReleased)
{
  // J w_0 + 3 t = 5 (t - 0.2 s) at t = 10.5 s; held with 3 N m of 5; free from 11 s on.
  Settings settings = GetParam();
  settings.push_back("run.step=1 ms");
  const SceneRun motion = run(rotor(2., "12 s") + "T = \"brake.force\"\n" + brake, settings);
  EXPECT_NEAR(time_of(motion, "stick"), 10.5, 1e-6);
  EXPECT_EQ(count(motion, "stick"), 1);
  EXPECT_EQ(count(motion, "slip_forward"), 0);
  EXPECT_NEAR(motion.signal("w").final, 1.5, 1e-6);
  EXPECT_NEAR(motion.signal("w").min, 0., 1e-6);
  expect_closed_balance(motion, 1e-4);
}

TEST(Brake, SlipsUnderALoadAboveItsCapacityAndSaysWhatIsWrong)
{
  const SceneRun motion = run(rotor(2., "3 s") + element("load", "force", {{"from", "shaft"}, {"constant", "3 N m"}}) +
                              element("brake", "brake",
                                      {{"from", "shaft"},
                                       {"capacity", "5 N m"},
                                       {"static_capacity", "6 N m"},
                                       {"initial_engagement", "1"},
                                       {"engagement", "[{ at = '1 s', to = 0.2, rate = '0.5/s' }]"}}));
  EXPECT_NEAR(time_of(motion, "slip_forward"), 2., 1e-9); // 6 (1 - (t - 1)/2) = 3
  // From 2 s on 3 - 5 (1 - (t - 1)/2), from 2.6 s on 3 - 1 N m.
  EXPECT_NEAR(motion.signal("w").final, ((3. - 2.5) * 0.6 + 2.5 * 0.18 + 2. * 0.4) / 2., 1e-6);
  const std::string scene = rotor(2., "12 s") + brake;
  EXPECT_EQ(complaint(scene), "");
  expect_complaint(scene, "is below 'capacity'", {"element.brake.static_capacity=4 N m"});
  expect_complaint(scene, "engagement = 1.5", {"element.brake.engagement=1.5"});
  expect_complaint(scene, "needs 'to'", {"element.brake.type=clutch"});
}

TEST_P(Drives, AreCoupledByAClutchUntilTheyTurnTogether)
{
  Settings settings = GetParam();
  settings.push_back("run.step=1 ms");
  const SceneRun motion = run(rotor(1., "4 s") + "w2 = 'load.speed'\n" + rotor_body("load", "3", "[0, 0, 1]") +
                                  element("clutch", "clutch",
                                          {{"from", "shaft"},
                                           {"to", "load"},
                                           {"capacity", "6 N m"},
                                           {"engagement", "[{ at = '0.5 s', to = 1 }]"}}) +
                                  start("v = { shaft = 10 }"),
                              settings);
  EXPECT_NEAR(time_of(motion, "stick"), 0.5 + 10. / (6. * (1. + 1. / 3.)), 1e-7);
  EXPECT_NEAR(motion.signal("w").final, 2.5, 1e-7);
  EXPECT_NEAR(motion.signal("w2").final, 2.5, 1e-7);
  EXPECT_NEAR(motion.result.energy.dissipated, 0.5 * 0.75 * 100., 1e-4);
}

TEST_P(Drives, AndABrakeWorkTogetherThoughTheDriveHasAVirtualCoordinate)
{
  // The brake holds against the drive's integral, which grows by k_i w_r: 20 N m/rad * 1 rad/s; from 5 N m on it slips.
  Settings settings = GetParam();
  settings.push_back("element.drive.speed=1 rad/s");
  settings.push_back("element.drive.proportional_gain=0.001 N m s/rad");
  const SceneRun motion =
      run(rotor(2., "0.3 s") + controller +
              element("brake", "brake", {{"from", "shaft"}, {"capacity", "5 N m"}, {"engagement", "1"}}),
          settings);
  EXPECT_NEAR(time_of(motion, "slip_forward"), (5. - 0.001) / 20., 1e-5);
}

} // namespace
} // namespace gestell::tests
