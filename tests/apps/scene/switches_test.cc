// Switches: what they tell, when, and that the balance stays closed, against solutions by hand.

#include "tests/support/scene_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gestell::tests
{
namespace
{

using Switches = ::testing::TestWithParam<Settings>;
INSTANTIATE_TEST_SUITE_P(Methods, Switches, ::testing::Values(fixed, controlled));

/// Keys of a switch [switch.NAME].
std::string switched(const std::string &name, const std::string &keys)
{
  return "[switch." + name + "]\n" + keys;
}

const std::string push   = "[element.push]\ntype = \"force\"\nfrom = \"slide\"\nconstant = \"10 N\"\n";
const std::string spring = "[element.spring]\ntype = \"spring-damper\"\nfrom = \"slide\"\nstiffness = \"800 N/m\"\n";

// --- off and on

TEST_P(Switches, TakeAForceAwayAtATime)
{
  const auto motion = run(slider(2., "1 s") + "F = \"push.force\"\n" + push +
                              switched("end", "when = \"t\"\nabove = \"0.3 s\"\ntell = \"push\"\norder = \"off\"\n"),
                          GetParam());
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
                                switched("end", "when = \"spring.displacement\"\nbelow = \"5 mm\"\ntell = \"spring\"\n"
                                                  "order = \"off\"\n"),
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
  const auto   motion = run(slider(2., "0.1 s") + "F = \"spring.force\"\n" + spring + "initially = \"off\"\n" +
                                "[start]\nv = { slide = \"1 m/s\" }\n" +
                                switched("begin", "when = \"slide.displacement\"\nabove = \"5 mm\"\ntell = \"spring\"\n"
                                                    "order = \"on\"\n"),
                            GetParam());
  const double s      = 20. * (0.1 - 0.005);
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
  const auto motion =
      run(rotor(2., "2 s") + "M = \"brake.torque\"\nP = \"motor.power\"\n" + motor + brake +
              switched("stop", "when = \"shaft.speed\"\nabove = \"8 rad/s\"\ntell = \"motor\"\norder = \"off\"\n") +
              switched("brake", "when = \"shaft.speed\"\nabove = \"8 rad/s\"\ndelay = \"0.1 s\"\ntell = \"brake\"\n"
                                "order = \"on\"\n"),
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
  const auto motion = run(rotor(2., "1.2 s") + motor + brake +
                          switched("stop", "when = \"shaft.speed\"\nabove = \"8 rad/s\"\norders = [{ tell = \"motor\", "
                                           "order = \"off\" }, { tell = \"brake\", order = \"on\" }]\n"));
  EXPECT_NEAR(time_of(motion, "stick"), 0.8 + 8. / 25., 1e-9);
  EXPECT_EQ(count(motion, "switch"), 1);
}

// --- courses

// A force that is raised by a ramp: v = (10 t + int)/2.
TEST_P(Switches, SetAForce)
{
  const auto motion =
      run(slider(2., "1 s") + "F = \"push.force\"\n" + push +
              switched("more", "when = \"slide.velocity\"\nabove = \"1 m/s\"\ntell = \"push\"\norder = \"set\"\n"
                               "to = \"40 N\"\nrate = \"100 N/s\"\n"),
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
          switched("go", "when = \"t\"\nabove = \"1 s\"\ntell = \"drive\"\norder = \"start\"\n") +
          switched("stop", "when = \"drive.wanted_speed\"\nabove = \"24 rad/s\"\ntell = \"drive\"\norder = \"brake\"\n"
                           "acceleration = \"48 rad/s^2\"\n"));
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
                          switched("stop", "when = \"t\"\nabove = \"0.4 s\"\ntell = \"feed\"\norder = \"brake\"\n"
                                           "acceleration = \"2 m/s^2\"\n"));
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
      switched("off", "when = \"slide.velocity\"\nabove = \"2 m/s\"\ntell = \"push\"\norder = \"off\"\nrepeat = true\n"
                      "hysteresis = \"0.5 m/s\"\n") +
      switched("on", "when = \"slide.velocity\"\nbelow = \"1 m/s\"\ntell = \"push\"\norder = \"on\"\nrepeat = true\n"
                     "hysteresis = \"0.5 m/s\"\n"));
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
  const std::string first =
      switched("first", "when = \"t\"\nabove = \"0.5 s\"\ntell = \"push\"\norder = \"set\"\nto = \"20 N\"\n");
  const auto motion =
      run(slider(2., "1 s") + push +
          switched("second", "after = \"first\"\nwhen = \"slide.velocity\"\nabove = \"1 m/s\"\ntell = \"push\"\n"
                             "order = \"off\"\n") +
          first);
  EXPECT_NEAR(time_of(motion, "switch", 0), 0.5, 1e-12);
  EXPECT_NEAR(time_of(motion, "switch", 1), 0.5, 1e-9);
  EXPECT_NEAR(motion.signal("v").final, 2.5, 1e-6);
}

// x = 10 mm cos(20 t) crosses 5 mm downwards first, then upwards, by the same switch.
TEST_P(Switches, CrossEitherWay)
{
  const std::string scene =
      slider(2., "0.6 s") + spring + "[start]\nq = { slide = \"10 mm\" }\n" + push + "initially = \"off\"\n";
  const auto way = [](const std::string &more)
  {
    return switched("s",
                    "when = \"slide.displacement\"\ncrosses = \"5 mm\"\ntell = \"push\"\norder = \"off\"\n" + more);
  };
  const auto once = run(scene + way(""), GetParam()), often = run(scene + way("repeat = true\n"), GetParam()),
             apart   = run(scene + way("repeat = true\nhysteresis = \"7 mm\"\n"), GetParam());
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
      run(slider(2., "0.1 s") + push +
              switched("s", "when = \"slide.displacement\"\ncrosses = \"0 m\"\ntell = \"push\"\norder = \"off\"\n"),
          GetParam());
  EXPECT_EQ(count(motion, "switch"), 0);
  ASSERT_EQ(motion.result.warnings.size(), 1u);
  EXPECT_NE(motion.result.warnings[0].find("never thrown"), std::string::npos);
}

TEST(Switches, OfTheTimeOfTheStartAreMeant)
{
  const auto motion =
      run(slider(2., "0.1 s") + push + switched("s", "when = \"t\"\nabove = 0\ntell = \"push\"\norder = \"off\"\n"));
  EXPECT_EQ(time_of(motion, "switch"), 0.);
  EXPECT_TRUE(motion.result.warnings.empty());
  EXPECT_NEAR(motion.signal("x").final, 0., 1e-15);
}

// Set to 40 N within 0.2 s while it is off, from 0.3 s on; on at 0.4 s, half way up: 25 N, and at 0.5 s 40 N.
TEST_P(Switches, GiveOrdersToWhatIsOff)
{
  const auto motion =
      run(slider(2., "1 s") + "F = \"push.force\"\n" + push + "initially = \"off\"\n" +
              switched("level", "when = \"t\"\nabove = \"0.3 s\"\ntell = \"push\"\norder = \"set\"\nto = \"40 N\"\n"
                                "rate = \"150 N/s\"\n") +
              switched("on", "when = \"t\"\nabove = \"0.4 s\"\ntell = \"push\"\norder = \"on\"\n"),
          GetParam());
  EXPECT_NEAR(time_of(motion, "next_segment"), 0.5, 1e-9);
  EXPECT_NEAR(motion.signal("F").max, 40., 1e-9);
  EXPECT_NEAR(motion.signal("v").final, (0.5 * (25. + 40.) * 0.1 + 40. * 0.5) / 2., 1e-5);
}

// Off and on again it keeps the level it was told, although its profile says 10 N.
TEST(Switches, LeaveOrdersStandingThatCameBefore)
{
  const auto motion =
      run(slider(2., "1 s") + "F = \"push.force\"\n" + push +
          switched("level", "when = \"t\"\nabove = \"0.1 s\"\ntell = \"push\"\norder = \"set\"\nto = \"30 N\"\n") +
          switched("off", "when = \"t\"\nabove = \"0.2 s\"\ntell = \"push\"\norder = \"off\"\n") +
          switched("on", "when = \"t\"\nabove = \"0.7 s\"\ntell = \"push\"\norder = \"on\"\n"));
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
              switched("go", "when = \"t\"\nabove = \"0.1 s\"\ntell = \"feed\"\norder = \"start\"\n") +
              switched("again", "when = \"t\"\nabove = \"0.6 s\"\ntell = \"feed\"\norder = \"start\"\n"));
  for (const std::string words : {"at t = 0.6 s, switch \"again\" tells \"feed\"", "jump from 0.5 to 0"})
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

TEST(Switches, RefuseWhatCannotBe)
{
  const std::string machine =
      slider(2., "1 s") + push + spring + "[element.mass]\ntype = \"point mass\"\non = \"slide\"\nmass = 1\n";
  const auto refuses = [&](const std::string &keys, const std::string &words)
  { expect_complaint(machine + switched("s", keys), words); };
  const std::string at_time = "when = \"t\"\nabove = \"1 s\"\n";
  refuses(at_time + "tell = \"push\"\norder = \"of\"\n", "knows no order 'of'; it obeys");
  refuses(at_time + "tell = \"spring\"\norder = \"brake\"\n", "knows no order 'brake'; it obeys 'on', 'off'");
  refuses(at_time + "tell = \"mass\"\norder = \"off\"\n", "is a mass");
  refuses(at_time + "tell = \"pusch\"\norder = \"off\"\n",
          "there is no element or joint 'pusch'; did you mean 'push'?");
  refuses(at_time + "tell = \"push\"\norder = \"set\"\n", "the key 'to' is missing; it needs a force");
  refuses(at_time + "tell = \"push\"\norder = \"set\"\nto = \"2 m\"\n", "switch.s.to");
  refuses(at_time + "tell = \"push\"\norder = \"off\"\nto = \"2 N\"\n", "unknown key 'to'");
  refuses(at_time + "tell = \"push\"\norder = \"off\"\nrepeat = true\n", "only once");
  refuses(at_time + "tell = \"push\"\norder = \"off\"\nhysteresis = \"1 s\"\n", "goes with repeat");
  refuses(at_time + "tell = \"push\"\norder = \"off\"\ndelay = \"-1 s\"\n", "switch.s.delay");
  refuses(at_time + "tell = \"push\"\norder = \"off\"\nafter = \"u\"\n", "there is no switch 'u'");
  refuses(at_time + "tell = \"push\"\norder = \"off\"\nafter = \"s\"\n", "in a circle");
  refuses(at_time + "orders = []\n", "orders");
  refuses(at_time + "below = \"2 s\"\ntell = \"push\"\norder = \"off\"\n", "cannot be given together with 'above'");
  refuses("when = \"t\"\ntell = \"push\"\norder = \"off\"\n", "needs 'above', 'below' or 'crosses'");
  refuses("when = \"slide.velocty\"\nabove = 1\ntell = \"push\"\norder = \"off\"\n",
          "when: there is no \"slide.velocty\"; did you mean 'slide.velocity'?");
  refuses("when = \"t\"\nabove = \"1 m\"\ntell = \"push\"\norder = \"off\"\n", "is in s, but the level is");
  refuses("when = \"slide.velocity\"\nabove = \"1 m/s\"\nrepeat = true\nhysteresis = \"1 m\"\ntell = \"push\"\n"
          "order = \"off\"\n",
          "is in m/s, but the hysteresis is");
  expect_complaint(slider(2., "1 s") + push + "initially = \"of\"\n", "element.push.initially");
  expect_complaint(machine + "initially = \"off\"\n", "cannot be switched");
}

TEST(Switches, RefuseWhatElementsCannotObey)
{
  const std::string at_time = "when = \"t\"\nabove = \"1 s\"\n";
  expect_complaint(rotor(2., "1 s") + motor + brake +
                       switched("s", at_time + "tell = \"brake\"\norder = \"set\"\nto = 2\n"),
                   "between 0 and 1");
  const std::string feed = "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\nmotion = { speed = 1 }\n";
  expect_complaint(slider(2., "1 s") + feed + switched("s", at_time + "tell = \"feed\"\norder = \"off\"\n"),
                   "is an ideal joint");
  const std::string pin = point_body("bob", "1", "[0, 0, 0]") +
                          joint("pin", "spherical", "ground", "bob", "[0, 0, 0]", {{"stiffness", "1e6"}});
  expect_complaint(slider(2., "1 s") + pin + switched("s", at_time + "tell = \"pin\"\norder = \"off\"\n"),
                   "is a compliant joint");
  expect_complaint(slider(2., "1 s") + feed + switched("s", at_time + "tell = \"feed\"\norder = \"brake\"\n"),
                   "no finite force makes masses jump");
  const std::string braked = "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\n"
                             "motion = { speed = 1, brake = { family = \"linear\", duration = \"0.1 s\" } }\n";
  expect_complaint(slider(2., "1 s") + braked +
                       switched("s", at_time + "tell = \"feed\"\norder = \"brake\"\njerk = 5\n"),
                   "takes neither an acceleration nor a jerk");
  expect_complaint(slider(2., "1 s") + braked + switched("s", at_time + "tell = \"feed\"\norder = \"hold\"\n"),
                   "knows no order 'hold'; it obeys 'brake'");
  // A name that is missing is mistaken for nothing that could not obey: a joint is never off.
  expect_complaint(slider(2., "1 s") + feed + push + switched("s", at_time + "tell = \"feet\"\norder = \"off\"\n"),
                   "there is no element or joint 'feet'; valid: 'push'");
  const std::string jumps =
      "[joint.feed]\ntype = \"prescribed motion\"\non = \"slide\"\nmotion = { speed = 1, waits = true }\n";
  expect_complaint(slider(2., "1 s") + jumps, "jump of the speed at its start");
  expect_complaint(rotor(2., "1 s") + "[element.m]\non = \"shaft\"\nto = \"shaft\"\n" + kloss, "element.m.to");
}

} // namespace
} // namespace gestell::tests
