// Switches: what they tell, when, and that the balance stays closed, against solutions by hand.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using Switches = ::testing::TestWithParam<Settings>;
INSTANTIATE_TEST_SUITE_P(Methods, Switches, ::testing::Values(fixed, controlled));

/// switched("end", "t above 0.3 s", "push off"): a switch, what throws it and what it tells.
std::string switched(const std::string &name, const std::string &when, const std::string &order, const Keys &more = {})
{
  const std::size_t relation = when.find(' '), level = when.find(' ', relation + 1), obeys = order.find(' ');
  return table("switch." + name,
               {{"when", when.substr(0, relation)},
                {when.substr(relation + 1, level - relation - 1), when.substr(level + 1)},
                {"tell", order.substr(0, obeys)},
                {"order", order.substr(obeys + 1)}},
               more);
}

const std::string push   = "[element.push]\ntype = \"force\"\nfrom = \"slide\"\nconstant = \"10 N\"\n";
const std::string spring = "[element.spring]\ntype = \"spring-damper\"\nfrom = \"slide\"\nstiffness = \"800 N/m\"\n";

// --- off and on

TEST_P(Switches, TakeAForceAwayAtATime)
{
  const auto motion =
      run(slider(2., "1 s") + "F = \"push.force\"\n" + push + switched("end", "t above 0.3 s", "push off"), GetParam());
  EXPECT_NEAR(time_of(motion, "switch"), 0.3, 1e-12);
  EXPECT_NEAR(motion.signal("v").final, 5. * 0.3, 1e-7);
  EXPECT_NEAR(motion.signal("x").final, 2.5 * 0.09 + 1.5 * 0.7, 1e-7);
  EXPECT_EQ(motion.signal("F").final, 0.);
  EXPECT_NEAR(motion.result.energy.input, 2.25, 1e-6);
  expect_closed_balance(motion, 1e-6);
}

// x = 10 mm cos 20 t; at 5 mm the spring is taken out with 800 N/m (5 mm)^2/2 = 10 mJ in it.
TEST_P(Switches, DissipateWhatASpringHasStored)
{
  const auto   motion = run(slider(2., "0.2 s") + spring + "[start]\nq = { slide = \"10 mm\" }\n" +
                                switched("end", "spring.displacement below 5 mm", "spring off"),
                            GetParam());
  const double t = std::acos(0.5) / 20., v = -20. * 0.01 * std::sqrt(0.75);
  EXPECT_NEAR(time_of(motion, "switch"), t, 1e-7);
  EXPECT_NEAR(motion.signal("v").final, v, 1e-6);
  EXPECT_NEAR(motion.signal("x").final, 0.005 + v * (0.2 - t), 1e-7);
  EXPECT_NEAR(motion.result.energy.dissipated, 0.01, 1e-6);
  expect_closed_balance(motion, 1e-4);
}

// A spring that is put in where the slide has come to 5 mm, at 1 m/s: x = 5 mm cos + 1/20 sin.
TEST_P(Switches, PutASpringIn)
{
  const auto motion =
      run(slider(2., "0.1 s") + "F = \"spring.force\"\n" + spring + "initially = \"off\"\n" +
              "[start]\nv = { slide = \"1 m/s\" }\n" + switched("begin", "slide.displacement above 5 mm", "spring on"),
          GetParam());
  const double s = 20. * (0.1 - 0.005);
  EXPECT_NEAR(motion.signal("x").final, 0.005 * std::cos(s) + 0.05 * std::sin(s), 2e-6);
  EXPECT_NEAR(motion.signal("F").final, 800. * motion.signal("x").final, 1e-9);
  EXPECT_LT(std::abs(motion.result.energy.dissipated), 1e-5); // although the spring came tight
  EXPECT_LT(std::abs(motion.result.energy.residual), 1e-6);   // [J] of 1 J that goes to and fro
}

const std::string motor = "[element.motor]\ntype = \"force profile\"\nfrom = \"shaft\"\nprofile = \"20 N m\"\n";
const std::string brake = "[element.brake]\ntype = \"brake\"\nfrom = \"shaft\"\ncapacity = \"50 N m\"\n"
                          "engagement = 1\ninitially = \"off\"\n";

// Emergency stop: the motor off and, 0.1 s later, the brake on.  w = 10 t up to 8 rad/s, then -25 rad/s^2.
TEST_P(Switches, StopAMachine)
{
  const auto motion = run(rotor(2., "2 s") + "M = \"brake.torque\"\nP = \"motor.power\"\n" + motor + brake +
                              switched("stop", "shaft.speed above 8 rad/s", "motor off") +
                              switched("brake", "shaft.speed above 8 rad/s", "brake on", {{"delay", "0.1 s"}}),
                          GetParam());
  EXPECT_NEAR(time_of(motion, "switch"), 0.8, 1e-9);
  EXPECT_NEAR(time_of(motion, "orders"), 0.9, 1e-9);
  EXPECT_NEAR(time_of(motion, "stick"), 0.9 + 8. / 25., 1e-8);
  EXPECT_NEAR(motion.signal("phi").final, 3.2 + 0.8 + 32. / 25., 1e-6);
  EXPECT_EQ(motion.signal("M").unit, "N m");
  EXPECT_NEAR(motion.signal("M").max, 50., 1e-9);
  EXPECT_EQ(motion.signal("P").final, 0.);
  EXPECT_NEAR(motion.result.energy.dissipated, 64., 1e-4);
  expect_closed_balance(motion, 1e-5);
}

// Two orders of one switch at the same instant.
TEST(Switches, GiveSeveralOrdersAtOnce)
{
  const auto motion =
      run(rotor(2., "1.2 s") + motor + brake +
          table("switch.stop", {{"when", "shaft.speed"},
                                {"above", "8 rad/s"},
                                {"orders", "[{ tell = 'motor', order = 'off' }, { tell = 'brake', order = 'on' }]"}}));
  EXPECT_NEAR(time_of(motion, "stick"), 0.8 + 8. / 25., 1e-9);
  EXPECT_EQ(count(motion, "switch"), 1);
}

// --- courses

// A force that is raised by a ramp: v = (10 t + int)/2.
TEST_P(Switches, SetAForce)
{
  const auto motion =
      run(slider(2., "1 s") + "F = \"push.force\"\n" + push +
              switched("more", "slide.velocity above 1 m/s", "push set", {{"to", "40 N"}, {"rate", "100 N/s"}}),
          GetParam());
  EXPECT_NEAR(time_of(motion, "switch"), 0.2, 1e-9);
  EXPECT_NEAR(time_of(motion, "next_segment"), 0.5, 1e-9);
  EXPECT_NEAR(motion.signal("v").final, (10. * 0.2 + 25. * 0.3 + 40. * 0.5) / 2., 2e-6);
  expect_closed_balance(motion, 1e-6);
}

const std::string controller = element("drive", "speed drive",
                                       {{"on", "shaft"},
                                        {"proportional_gain", "10 N m s/rad"},
                                        {"speed", "[{ at = '0.5 s', to = '30 rad/s', acceleration = '20 rad/s^2' }]"}});

TEST(Switches, StartAndBrakeADrive)
{
  const auto motion =
      run(rotor(2., "4 s") + "wanted = \"drive.wanted_speed\"\n" + controller + "waits = true\n" +
          switched("go", "t above 1 s", "drive start") +
          switched("stop", "drive.wanted_speed above 24 rad/s", "drive brake", {{"acceleration", "48 rad/s^2"}}));
  // The ramp begins at 1.5 s; 24 rad/s are reached 1.2 s later.
  EXPECT_NEAR(time_of(motion, "next_segment", 0), 1.5, 1e-9);
  EXPECT_NEAR(time_of(motion, "switch", 1), 2.7, 1e-9);
  EXPECT_NEAR(time_of(motion, "next_segment", 1), 3.2, 1e-9);
  EXPECT_NEAR(motion.signal("wanted").max, 24., 1e-6);
  EXPECT_EQ(motion.signal("wanted").final, 0.);
}

// A joint's motion at constant speed is braked with the deceleration of the order: v^2/(2 a).
TEST(Switches, BrakeAPrescribedMotion)
{
  const auto motion = run(slider_body("slide", "2", "[1, 0, 0]") +
                          joint("feed", "prescribed motion", {{"on", "slide"}, {"motion", "{ speed = '0.5 m/s' }"}}) +
                          steps("1 ms", "1 s") + "[output.signals]\nx = 'slide.displacement'\n" +
                          switched("stop", "t above 0.4 s", "feed brake", {{"acceleration", "2 m/s^2"}}));
  EXPECT_NEAR(time_of(motion, "next_segment"), 0.65, 1e-9);
  EXPECT_NEAR(motion.signal("x").final, 0.2 + 0.25 / 4., 1e-8);
}

TEST_P(Switches, FollowFormulasAndTables)
{
  const double w = 2. * M_PI;
  const auto   a = run(slider(2., "0.75 s") + "[element.push]\ntype = \"force profile\"\nfrom = \"slide\"\n"
                                                "profile = \"10 N*sin(2*pi*1 Hz*t)\"\n",
                       GetParam());
  EXPECT_NEAR(a.signal("v").final, 5. / w * (1. - std::cos(w * 0.75)), 1e-6);
  const auto b = run(slider(2., "2 s") + "[element.push]\ntype = \"force profile\"\nfrom = \"slide\"\n"
                                         "profile = { table = [[0, 0], [\"1 s\", \"3 N\"], [\"2 s\", \"12 N\"]] }\n",
                     GetParam());
  EXPECT_NEAR(b.signal("v").final, 8. / 2., 1e-6); // the spline is 3 N/s^2 t^2
}

// --- when

// Heating by hand: m v' = F - d v between 1 m/s and 2 m/s, with F on below and off above.
TEST(Switches, RepeatBetweenTwoLevels)
{
  const auto motion = run(
      slider(2., "6 s") + push + "[element.air]\ntype = \"spring-damper\"\nfrom = \"slide\"\ndamping = \"2 N s/m\"\n" +
      switched("off", "slide.velocity above 2 m/s", "push off", {{"repeat", "true"}, {"hysteresis", "0.5 m/s"}}) +
      switched("on", "slide.velocity below 1 m/s", "push on", {{"repeat", "true"}, {"hysteresis", "0.5 m/s"}}));
  // m/d = 1 s, F/d = 5 m/s: up from v_0 to v_1 in log((5 - v_0)/(5 - v_1)), down in log(v_0/v_1).
  const double        up = std::log(4. / 3.), down = std::log(2.);
  std::vector<double> times;
  for (const auto &event : motion.result.events)
    if (event.kind == "switch")
      times.push_back(event.t);
  ASSERT_GE(times.size(), 9u);
  // At the start the velocity is below 1 m/s already: that switch is thrown at once.
  EXPECT_EQ(times[0], 0.);
  EXPECT_NEAR(times[1], std::log(5. / 3.), 1e-7);
  for (std::size_t i = 2; i < 8; ++i)
    EXPECT_NEAR(times[i] - times[i - 1], i % 2 == 0 ? down : up, 1e-7);
}

// The second one watches from the orders of the first on; what lies beyond its value then throws it at once.
TEST(Switches, WaitForEachOther)
{
  const std::string first  = switched("first", "t above 0.5 s", "push set", {{"to", "20 N"}});
  const auto        motion = run(slider(2., "1 s") + push +
                                 switched("second", "slide.velocity above 1 m/s", "push off", {{"after", "first"}}) + first);
  EXPECT_NEAR(time_of(motion, "switch", 0), 0.5, 1e-12);
  EXPECT_NEAR(time_of(motion, "switch", 1), 0.5, 1e-9);
  EXPECT_NEAR(motion.signal("v").final, 2.5, 1e-6);
}

// x = 10 mm cos(20 t) crosses 5 mm downwards first, then upwards, by the same switch.
TEST_P(Switches, CrossEitherWay)
{
  const std::string scene =
      slider(2., "0.6 s") + spring + "[start]\nq = { slide = \"10 mm\" }\n" + push + "initially = \"off\"\n";
  const auto way  = [](const Keys &more) { return switched("s", "slide.displacement crosses 5 mm", "push off", more); };
  const auto once = run(scene + way({}), GetParam()), often = run(scene + way({{"repeat", "true"}}), GetParam()),
             apart   = run(scene + way({{"repeat", "true"}, {"hysteresis", "7 mm"}}), GetParam());
  const double first = std::acos(0.5) / 20., period = 2. * M_PI / 20.;
  EXPECT_EQ(count(once, "switch"), 1);
  EXPECT_NEAR(time_of(once, "switch"), first, 1e-7);
  ASSERT_EQ(count(often, "switch"), 4);
  for (int n = 0; n < 4; ++n)
    EXPECT_NEAR(time_of(often, "switch", n), n % 2 == 0 ? first + n / 2 * period : (n + 1) / 2 * period - first, 1e-6);
  // 7 mm off the level it comes only below, where it is ready for the way up; the way down is past then.
  ASSERT_EQ(count(apart, "switch"), 3);
  EXPECT_NEAR(time_of(apart, "ready"), std::acos(-0.2) / 20., 1e-6);
  EXPECT_NEAR(time_of(apart, "switch", 1), period - first, 1e-6);
}

// One that begins at the value itself has not crossed it.
TEST_P(Switches, CrossNothingWhereTheyBegin)
{
  const auto motion =
      run(slider(2., "0.1 s") + push + switched("s", "slide.displacement crosses 0 m", "push off"), GetParam());
  EXPECT_EQ(count(motion, "switch"), 0);
  ASSERT_EQ(motion.result.findings.size(), 1u);
  EXPECT_EQ(motion.result.findings[0].id, "switch-never-thrown");
  EXPECT_EQ(motion.result.findings[0].place, "s");
}

TEST(Switches, OfTheTimeOfTheStartAreMeant)
{
  const auto motion = run(slider(2., "0.1 s") + push + switched("s", "t above 0", "push off"));
  EXPECT_EQ(time_of(motion, "switch"), 0.);
  EXPECT_TRUE(motion.result.findings.empty());
  EXPECT_NEAR(motion.signal("x").final, 0., 1e-15);
}

// Set to 40 N within 0.2 s while it is off, from 0.3 s on; on at 0.4 s, half way up: 25 N, and at 0.5 s 40 N.
TEST_P(Switches, GiveCommandsToWhatIsOff)
{
  const auto motion = run(slider(2., "1 s") + "F = \"push.force\"\n" + push + "initially = \"off\"\n" +
                              switched("level", "t above 0.3 s", "push set", {{"to", "40 N"}, {"rate", "150 N/s"}}) +
                              switched("on", "t above 0.4 s", "push on"),
                          GetParam());
  EXPECT_NEAR(time_of(motion, "next_segment"), 0.5, 1e-9);
  EXPECT_NEAR(motion.signal("F").max, 40., 1e-9);
  EXPECT_NEAR(motion.signal("v").final, (0.5 * (25. + 40.) * 0.1 + 40. * 0.5) / 2., 1e-5);
}

// Off and on again it keeps the level it was told, although its profile says 10 N.
TEST(Switches, LeaveOrdersStandingThatCameBefore)
{
  const auto motion = run(slider(2., "1 s") + "F = \"push.force\"\n" + push +
                          switched("level", "t above 0.1 s", "push set", {{"to", "30 N"}}) +
                          switched("off", "t above 0.2 s", "push off") + switched("on", "t above 0.7 s", "push on"));
  EXPECT_EQ(motion.signal("F").final, 30.);
  EXPECT_NEAR(motion.signal("v").final, (10. * 0.1 + 30. * 0.1 + 30. * 0.3) / 2., 1e-6);
}

// "start" once more brings the profile back to its begin, at rest: a moving body would have to jump.
TEST(Switches, EndARunInWhichASecondStartWouldMakeTheSpeedJump)
{
  const std::string feed =
      "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\nmotion = { speed = [{ at = 0, to = "
      "\"0.5 m/s\", acceleration = \"2 m/s^2\" }], waits = true }\n";
  const auto motion =
      stopped("[body.slide]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = 2\n" + feed +
              "[run]\nstep = \"1 ms\"\nend = \"1 s\"\n[output.signals]\nx = \"slide.displacement\"\n" +
              switched("go", "t above 0.1 s", "feed start") + switched("again", "t above 0.6 s", "feed start"));
  for (const std::string words : {"at t = 0.6 s, switch \"again\" commands \"feed\"", "jump from 0.5 to 0"})
    EXPECT_NE(motion.result.failure.find(words), std::string::npos) << motion.result.failure;
  EXPECT_NEAR(motion.signal("x").final, 0.5 * 0.5 - 0.5 * 0.25 * 0.5, 1e-6); // saved until then
}

// --- units and aliases

TEST(Signals, OfAnglesAreTorques)
{
  const auto motion = run(rotor(2., "0.1 s") + R"(a = "stop.force"
b = "stop.torque"
c = "stop.displacement"
d = "stop.angle"
e = "hinge.force"
)" + element("stop", "stop", {{"from", "shaft"}, {"gap", "-1 deg"}, {"stiffness", "100 N m/rad"}}) +
                          element("hinge", "friction", {{"from", "shaft"}, {"force", "1 N m"}}));
  EXPECT_EQ(motion.signal("a").unit, "N m");
  EXPECT_EQ(motion.signal("a").final, motion.signal("b").final);
  EXPECT_EQ(motion.signal("c").unit, "rad");
  EXPECT_EQ(motion.signal("d").unit, "rad");
  EXPECT_EQ(motion.signal("e").unit, "N m");
}

// --- motors react on what carries the rotor

const std::string hung = R"([frame]
mass = [[10]]
stiffness = [[0]]
[frame.interface.a]
rows = { ry = 1 }
)" + rotor_body("rotor", "2", "[0, 1, 0]", {{"on", "frame.a"}}) +
                         steps("1 ms", "0.5 s") +
                         signals("frame = 'frame.a.ry_rate', w = 'rotor.speed', T = 'motor.torque'") +
                         "[element.motor]\non = 'rotor'\n";
const std::string kloss     = "type = \"asynchronous motor\"\nbreakdown_torque = 20\nbreakdown_slip = 0.2\n"
                              "synchronous_speed = 10\n";
const std::string regulated = "type = \"speed drive\"\nproportional_gain = 3\nspeed = 10\n";

TEST(Motors, ReactOnTheirCarrier)
{
  for (const std::string &type : {kloss, kloss + "time_constant = 0.02\n", regulated})
  {
    std::string scene = hung + type;
    if (type.find("time_constant") != std::string::npos)
      scene.replace(scene.find("asynchronous"), 12, "dynamic");
    const auto motion = run(scene);
    EXPECT_GT(motion.signal("w").final, 1.);
    // no torque from outside: 10 ry' + 2 w = 0
    EXPECT_NEAR(10. * motion.signal("frame").final, -2. * motion.signal("w").final, 1e-9);
    expect_closed_balance(motion, 1e-4);

    const auto on_ground = run(scene + "to = \"ground\"\n");
    EXPECT_EQ(on_ground.signal("frame").final, 0.);
    EXPECT_GT(on_ground.signal("w").final, 1.);
  }
}

// The drive keeps the speed of its rotor against the stator: (10 - (w - ry')) k_p.
TEST(Motors, KeepTheSpeedAgainstTheirStator)
{
  const auto motion = run(hung + regulated);
  EXPECT_NEAR(motion.signal("T").final, 3. * (10. - motion.signal("w").final + motion.signal("frame").final), 1e-9);
}

// --- bad input

std::string at_time(const std::string &order, const Keys &more = {})
{
  return switched("s", "t above 1 s", order, more);
}

TEST(Switches, RefuseWhatCannotBe)
{
  const std::string machine =
      slider(2., "1 s") + push + spring + "[element.mass]\ntype = \"point mass\"\non = \"slide\"\nmass = 1\n";
  const auto refuses = [&](const std::string &order, const std::string &words, const Keys &more = {})
  { expect_complaint(machine + at_time(order, more), words); };
  refuses("push of", "does not accept the command 'of'; it accepts");
  refuses("spring brake", "does not accept the command 'brake'; it accepts 'on', 'off'");
  refuses("mass off", "is a mass");
  refuses("pusch off", "there is no element or joint 'pusch'; did you mean 'push'?");
  refuses("push set", "the key 'to' is missing; it needs a force");
  refuses("push set", "switch.s.to", {{"to", "2 m"}});
  refuses("push off", "unknown key 'to'", {{"to", "2 N"}});
  refuses("push off", "only once", {{"repeat", "true"}});
  refuses("push off", "needs repeat", {{"hysteresis", "1 s"}});
  refuses("push off", "switch.s.delay", {{"delay", "-1 s"}});
  refuses("push off", "there is no switch 'u'", {{"after", "u"}});
  refuses("push off", "none would ever be armed", {{"after", "s"}});
  refuses("push off", "cannot be given together with 'above'", {{"below", "2 s"}});
  const auto wrong = [&](const std::string &keys, const std::string &words)
  { expect_complaint(machine + "[switch.s]\n" + test::quoted(keys), words); };
  wrong("when = 't'\nabove = '1 s'\norders = []\n", "orders");
  wrong("when = 't'\ntell = 'push'\norder = 'off'\n", "needs 'above', 'below' or 'crosses'");
  const auto when = [&](const std::string &level, const std::string &words, const Keys &more = {})
  { expect_complaint(machine + switched("s", level, "push off", more), words); };
  when("slide.velocty above 1", "when: there is no \"slide.velocty\"; did you mean 'slide.velocity'?");
  when("t above 1 m", "is in s, but the level is");
  when("slide.velocity above 1 m/s", "is in m/s, but the hysteresis is", {{"repeat", "true"}, {"hysteresis", "1 m"}});
  expect_complaint(slider(2., "1 s") + push + "initially = \"of\"\n", "element.push.initially");
  expect_complaint(machine + "initially = \"off\"\n", "cannot be switched");
}

TEST(Switches, RefuseWhatElementsCannotObey)
{
  expect_complaint(rotor(2., "1 s") + motor + brake + at_time("brake set", {{"to", "2"}}), "between 0 and 1");
  const std::string feed = "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\nmotion = { speed = 1 }\n";
  expect_complaint(slider(2., "1 s") + feed + at_time("feed off"), "is an ideal joint");
  const std::string pin = point_body("bob", "1", "[0, 0, 0]") +
                          joint("pin", "spherical", "ground", "bob", "[0, 0, 0]", {{"stiffness", "1e6"}});
  expect_complaint(slider(2., "1 s") + pin + at_time("pin off"), "is a compliant joint");
  expect_complaint(slider(2., "1 s") + feed + at_time("feed brake"), "needs an infinite force");
  const std::string braked = "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\n"
                             "motion = { speed = 1, brake = { family = \"linear\", duration = \"0.1 s\" } }\n";
  expect_complaint(slider(2., "1 s") + braked + at_time("feed brake", {{"jerk", "5"}}),
                   "allows neither an acceleration nor a jerk");
  expect_complaint(slider(2., "1 s") + braked + at_time("feed hold"),
                   "does not accept the command 'hold'; it accepts 'brake'");
  // A name that is missing is mistaken for nothing that could not obey: a joint is never off.
  expect_complaint(slider(2., "1 s") + feed + push + at_time("feet off"),
                   "there is no element or joint 'feet'; valid: 'push'");
  const std::string jumps =
      "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\nmotion = { speed = 1, waits = true }\n";
  expect_complaint(slider(2., "1 s") + jumps, "jump of the speed at its start");
  expect_complaint(rotor(2., "1 s") + "[element.m]\non = \"shaft\"\nto = \"shaft\"\n" + kloss, "element.m.to");
}

} // namespace
} // namespace gestell::tests
