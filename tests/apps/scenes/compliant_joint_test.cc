// Compliant joints in scenes: against closed forms, against ideal joints, and in loops that ideal joints hold too
// often.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A bar of 2 kg and 0.5 kg m^2 whose centre of mass is 0.4 m from its pin on the ground.
std::string bar(const std::string &type, const std::string &joint)
{
  return (type == "planar" ? planar_body("bar", "2", "0.5", "[0.4, 0, 0]")
                           : rigid_body("bar", "2", "[0.3, 0.5, 0.4]", "[0.4, 0, 0]")) +
         "[joint.pin]\nfrom = \"ground\"\nto = \"bar\"\nat = [0, 0, 0]\n" + joint + "\n";
}

const std::string still = start("rule = 'static'") + steps("1 ms", "2 ms");

// A bar that turns at omega pulls its pin open by e = m omega^2 r/(k - m omega^2): a steady motion, whose force
// k e = m omega^2 (r + e) tends to the ideal joint's as 1/k.
TEST(CompliantJoint, ASpinningBarOpensItsPinAsInTheClosedForm)
{
  const double m = 2., r = 0.4, omega = 10.;
  double       before = 0.;
  for (const double k : {1e4, 1e5, 1e6})
  {
    const double e = m * omega * omega * r / (k - m * omega * omega);
    const auto   motion =
        run(bar("planar", "type = \"revolute\"\nstiffness = " + number(k)) +
            start("q = { 'bar.ux' = " + number(e) + ", 'bar.uz' = 0, 'bar.angle' = 0 }\n" +
                  "v = { 'bar.ux' = 0, 'bar.uz' = " + number(-omega * (r + e)) + ", 'bar.angle' = 10 }") +
            steps("0.1 ms", "0.3 s") + signals("F = 'pin.resultant', phi = 'bar.angle'"));
    // BDF2 errs by the share (omega h)^2 = 1e-6 and less; its first step of order 1 excites the pin a little.
    EXPECT_NEAR(motion.signal("phi").final, omega * 0.3, 1e-6);
    EXPECT_NEAR(motion.signal("F").min, k * e, 1e-4 * k * e) << k;
    EXPECT_NEAR(motion.signal("F").max, k * e, 1e-4 * k * e) << k;
    const double off = motion.signal("F").final / (m * omega * omega * r) - 1.;
    if (before > 0.)
    {
      EXPECT_NEAR(off, 0.1 * before, 0.02 * before);
    }
    before = off;
  }
}

// What holds the bar at rest: m g at the pin, m g r cos phi = k_r phi about it.
TEST(CompliantJoint, AClampedBarSagsAsItsStiffnessesSay)
{
  const std::string weight = "gravity = [0, 0, -9.81]\n";
  const auto        planar = run(
             weight + bar("planar", "type = \"rigid\"\nstiffness = [1e4, 5e4, 2e4]\nrotational_stiffness = \"20 N m/rad\"") +
             still +
             "[output.signals]\nphi = \"bar.angle\"\nz = \"bar.uz\"\nx = \"bar.ux\"\nT = \"pin.torque\"\nF = "
                    "\"pin.fz\"\n");
  double phi = 0.;
  for (int i = 0; i < 60; ++i)
    phi = 2. * 9.81 * 0.4 * std::cos(phi) / 20.;
  EXPECT_NEAR(planar.signal("phi").final, phi, 1e-12);
  EXPECT_NEAR(planar.signal("T").final, -20. * phi, 1e-10);
  EXPECT_NEAR(planar.signal("F").final, 2. * 9.81, 1e-9);
  EXPECT_NEAR(planar.signal("z").final, -2. * 9.81 / 2e4 - 0.4 * std::sin(phi), 1e-12);
  EXPECT_NEAR(planar.signal("x").final, 0.4 * (std::cos(phi) - 1.), 1e-12);

  // In space s = sin phi is opposed by lambda = -k_r sin phi, which acts with the lever cos phi: m g r = k_r sin phi.
  const auto rigid =
      run(weight + bar("rigid", "type = \"rigid\"\nstiffness = 1e4\nrotational_stiffness = \"20 N m/rad\"") + still +
          "[output.signals]\nphi = \"bar.ry\"\nz = \"bar.uz\"\nT = \"pin.my\"\n");
  const double tilt = std::asin(2. * 9.81 * 0.4 / 20.);
  EXPECT_NEAR(rigid.signal("phi").final, tilt, 1e-12);
  EXPECT_NEAR(rigid.signal("T").final, -20. * std::sin(tilt), 1e-10);
  EXPECT_NEAR(rigid.signal("z").final, -2. * 9.81 / 1e4 - 0.4 * std::sin(tilt), 1e-12);
}

// Three stiffnesses turn with `from`: on a table turned by a right angle the soft direction is upright.
TEST(CompliantJoint, StiffnessesOfThreeDirectionsTurnWithTheFirstBody)
{
  const auto motion = run(
      "gravity = [0, 0, -9.81]\n" + rotor_body("table", "1", "[0, 1, 0]") + point_body("load", "3", "[0.5, 0, 0]") +
      joint("pad", "spherical", "table", "load", "[0.5, 0, 0]", {{"stiffness", "['1 kN/m', '50 kN/m', '20 kN/m']"}}) +
      element("lock", "spring-damper", {{"from", "table"}, {"stiffness", "1e12 N m/rad"}, {"rest", "90 deg"}}) +
      start("rule = 'static'\nq = { table = '90 deg' }") + steps("1 ms", "2 ms") +
      signals("z = 'load.z', x = 'load.x'"));
  EXPECT_NEAR(motion.signal("z").final, -0.5 - 3. * 9.81 / 1e3, 1e-9);
  EXPECT_NEAR(motion.signal("x").final, 0., 1e-9);
}

// Two bars in a line that turn about their common pin pull it open by e = m omega^2 r/(k - m omega^2/2) and keep it so.
// Nothing moves that one of them sees of the other: no damper brakes them, along axes that turn with `from`.
TEST(CompliantJoint, DampingBrakesNoBodiesThatTurnTogether)
{
  const double m = 2., r = 0.4, omega = 10., k = 1e4, e = m * omega * omega * r / (k - 0.5 * m * omega * omega);
  for (const std::string values : {"1e4", "[1e4, 1e4, 1e4]"})
  {
    const std::string state =
        "q = { 'a.ux' = " + number(-0.5 * e) + ", 'a.uz' = 0, 'a.angle' = 0, 'b.ux' = " + number(0.5 * e) +
        ", 'b.uz' = 0, 'b.angle' = 0 }\nv = { 'a.ux' = 0, 'a.uz' = " + number(omega * (r + 0.5 * e)) +
        ", 'a.angle' = 10, 'b.ux' = 0, 'b.uz' = " + number(-omega * (r + 0.5 * e)) + ", 'b.angle' = 10 }";
    const auto motion =
        run(planar_body("a", "2", "0.5", "[-0.4, 0, 0]") + planar_body("b", "2", "0.5", "[0.4, 0, 0]") +
                revolute("pin", "a", "b", "[0, 0, 0]",
                         {{"stiffness", values}, {"damping", values == "1e4" ? "2e3" : "[2e3, 2e3, 2e3]"}}) +
                start(state) + steps("1 ms", "0.3 s") +
                signals("wa = 'a.speed', wb = 'b.speed', F = 'pin.resultant', Fx = 'pin.fx', Fz = "
                        "'pin.fz'"),
            {"run.tolerance=1e-10"});
    const double energy = m * std::pow(omega * (r + 0.5 * e), 2) + 0.5 * omega * omega;
    // Along axes fixed in space d e^2 omega = 1.3 N m would brake 1.64 kg m^2: by 0.24 rad/s.
    for (const char *speed : {"wa", "wb"})
      for (const double value : {motion.signal(speed).min, motion.signal(speed).max})
        EXPECT_NEAR(value, omega, 1e-7 * omega) << speed << ' ' << values;
    EXPECT_LT(std::abs(motion.result.energy.dissipated), 1e-9 * energy);
    EXPECT_NEAR(motion.signal("F").min, k * e, 1e-5 * k * e); // the first step, of order 1, excites the pin a little
    // Forces are told in space, wherever the axes have turned to.
    EXPECT_NEAR(motion.signal("Fx").final, -k * e * std::cos(3.), 1e-6 * k * e) << values;
    EXPECT_NEAR(motion.signal("Fz").final, k * e * std::sin(3.), 1e-6 * k * e) << values;
  }
}

/// A rotor whose pin lies on its axis and a slider: seen from the rotor the slider moves along both axes.
std::string pinned_to_a_wheel(const std::string &damping)
{
  return rotor_body("wheel", "1", "[0, 1, 0]") + slider_body("slide", "2", "[1, 0, 0]") +
         revolute("pin", "wheel", "slide", "[0, 0, 0]", {{"stiffness", "1e3"}, {"damping", damping}}) +
         start("q = { slide = 0.01, wheel = '1 rad' }") + steps("1 ms", "0.2 s") +
         signals("x = 'slide.displacement', F = 'pin.fx'");
}

TEST(CompliantJoint, IsAsStiffInWhateverDirectionItsAxesHaveTurned)
{
  const auto damped = run(pinned_to_a_wheel("1e-9")), free = run(pinned_to_a_wheel("0"));
  EXPECT_NEAR(damped.at(0, 2), -10., 1e-9);
  EXPECT_NEAR(damped.signal("x").final, free.signal("x").final, 1e-9);
}

/// The four-bar linkage of double_four_bar.toml with all its joints compliant.
Settings compliant(const std::string &stiffness, const std::string &damping)
{
  Settings settings{"run.end=\"0.6 s\"", "run.step=\"1 ms\"", "output.picture_step=0"};
  for (const char *joint : {"A", "B", "\"B again\"", "C", "B0", "C0"})
  {
    settings.push_back(std::string("joint.") + joint + ".stiffness=\"" + stiffness + "\"");
    settings.push_back(std::string("joint.") + joint + ".damping=\"" + damping + "\"");
  }
  return settings;
}

// The motion of the linkage tends to that of ideal joints as 1/k, and no energy is lost but by dampers.
TEST(CompliantJoint, ALinkageTendsToThatOfIdealJoints)
{
  const SceneRun ideal("double_four_bar.toml", {"run.end=\"0.6 s\"", "run.step=\"1 ms\"", "output.picture_step=0"});
  const auto     off = [&](const SceneRun &run, const char *signal)
  { return std::abs(run.signal(signal).final - ideal.signal(signal).final); };
  const SceneRun soft("double_four_bar.toml", compliant("1 kN/mm", "2 kN s/m"));
  const SceneRun hard("double_four_bar.toml", compliant("10 kN/mm", "20 kN s/m"));
  EXPECT_GT(std::abs(ideal.signal("crank").final), 0.5); // it has gone some way
  for (const char *signal : {"crank", "first", "second"})
  {
    EXPECT_GT(off(soft, signal), 1e-8) << signal;
    EXPECT_NEAR(off(hard, signal), 0.1 * off(soft, signal), 0.03 * off(soft, signal)) << signal;
  }
  EXPECT_NEAR(hard.signal("F_B0").final, ideal.signal("F_B0").final, 1e-2 * ideal.signal("F_B0").final);
  EXPECT_EQ(hard.n, ideal.n);
  expect_closed_balance(hard, 1e-4);

  auto controlled = compliant("10 kN/mm", "20 kN s/m"); // which ideal joints do not know
  controlled.push_back("run.tolerance=1e-7");
  const SceneRun measured("double_four_bar.toml", controlled);
  expect_closed_balance(measured, 1e-6);
  EXPECT_NEAR(measured.signal("crank").final, hard.signal("crank").final, 1e-5);
}

// Bodies that move along the same directions give one difference: a pin between planar bodies has 4 measures, one on
// the ground its body's 3.
TEST(CompliantJoint, APinOfPlanarBodiesHasFourMeasures)
{
  const apps::Scene       scene   = apps::read_scene(shipped("double_four_bar.toml"), compliant("1 kN/mm", "2 kN s/m"));
  const coupling::Machine machine = apps::build_machine(scene);
  for (const auto &[joint, n] : {std::pair{"B", 4}, {"B again", 4}, {"B0", 3}})
    for (const coupling::ElementPlacement &element : machine.model().elements())
      if (element.name == joint)
      {
        EXPECT_EQ(element.element->n_measures(), n) << joint;
      }
}

std::string mount(const std::string &name, double x, double y)
{
  return joint(name, "spherical", "ground", "block", vector(x, y, 0.),
               {{"stiffness", "[1e5, 1e5, 2e5]"}, {"damping", "100"}});
}

// A rigid body on three mounts of the ground: each takes what statics and its stiffness give it, and has three
// measures.
TEST(CompliantJoint, AMountOfABodyInSpaceHasThreeMeasures)
{
  const std::string scene =
      "gravity = [0, 0, -10]\n" + rigid_body("block", "6", "[0.3, 0.5, 0.4]", "[0, 0, 0]") + mount("mount0", -1., 0.) +
      mount("mount1", 1., -0.5) + mount("mount2", 1., 0.5) +
      signals("z = 'block.uz', ry = 'block.ry', F0 = 'mount0.fz', F1 = 'mount1.fz', F2 = 'mount2.fz'");
  const auto motion = run(scene + still);
  EXPECT_NEAR(motion.signal("F0").final, 30., 1e-4);
  EXPECT_NEAR(motion.signal("F1").final, 15., 1e-4);
  EXPECT_NEAR(motion.signal("F2").final, 15., 1e-4);
  const double left = -30. / 2e5, right = -15. / 2e5; // at x = -1 and x = 1
  EXPECT_NEAR(motion.signal("z").final, 0.5 * (left + right), 1e-8);
  EXPECT_NEAR(motion.signal("ry").final, -0.5 * (right - left), 1e-8);

  const coupling::Machine machine = apps::build_machine(test::scene_of(scene));
  int                     mounts  = 0;
  for (const coupling::ElementPlacement &element : machine.model().elements())
    if (element.name.rfind("mount", 0) == 0)
    {
      EXPECT_EQ(element.element->n_measures(), 3);
      ++mounts;
    }
  EXPECT_EQ(mounts, 3);
}

/// Four rigid bodies in a closed loop of pins with parallel axes, from the crank angle phi.
std::string loop(const Keys &yields)
{
  const auto body = [&](const char *name, double x, double z)
  { return rigid_body(name, "2", "[0.03, 0.05, 0.04]", vector(x, 0., z)); };
  const auto pin = [&](const char *name, const char *from, const char *to, double x, double z)
  {
    Keys keys = {{"axis", "[0, 1, 0]"}};
    keys.insert(keys.end(), yields.begin(), yields.end());
    return revolute(name, from, to, vector(x, 0., z), keys);
  };
  return "gravity = [0, 0, -9.81]\n" + body("crank", 0., 0.15) + body("coupler", 0.4, 0.4) + body("rocker", 0.9, 0.25) +
         pin("A0", "ground", "crank", 0., 0.) + pin("A", "crank", "coupler", 0., 0.3) +
         pin("B", "coupler", "rocker", 0.8, 0.5) + pin("B0", "ground", "rocker", 1., 0.) +
         start("q = { 'crank.ry' = '20 deg', 'crank.rx' = 0, 'crank.rz' = 0 }") + steps("0.5 ms", "0.2 s") +
         signals("phi = 'crank.ry', psi = 'rocker.ry', x = 'rocker.uy', F = 'A.resultant'");
}

// Bodies in space in a loop of four parallel pins: ideal joints say three things twice.  Only the crank is given, the
// rest closes as with ideal joints.
TEST(CompliantJoint, ALoopThatIdealJointsHoldTooOftenRuns)
{
  expect_complaint(loop({}), "the joints are redundant");
  const auto motion = run(loop({{"stiffness", "20 kN/mm"},
                                {"damping", "5 kN s/m"},
                                {"rotational_stiffness", "1e5 N m/rad"},
                                {"rotational_damping", "20 N m s/rad"}}));
  EXPECT_LT(std::abs(motion.result.energy.residual), 1e-4); // [J], of some that weights and motion exchange
  // The rocker of lengths 0.3, l, 0.2 x 0.5 with the crank turned by 20 degrees, from where both circles meet.
  const double turned = 20. * M_PI / 180., l = std::hypot(0.8, 0.2), l_R = std::hypot(0.2, 0.5);
  const double ax = 0.3 * std::sin(turned), az = 0.3 * std::cos(turned), d = std::hypot(1. - ax, az);
  const double beta = std::atan2(az, ax - 1.), alpha = std::acos((d * d + l_R * l_R - l * l) / (2. * d * l_R));
  const double psi = -(beta - alpha - std::atan2(0.5, -0.2)); // positive about y: clockwise in x, z
  EXPECT_NEAR(motion.at(0, 2), psi, 1e-9);
  EXPECT_LT(motion.signal("F").max, 500.); // closed at the start: no force of millimetres
  EXPECT_GT(std::abs(motion.signal("phi").final - turned), 0.05);
  EXPECT_NEAR(motion.signal("x").max, 0., 1e-9); // it stays in its plane
}

// The guard of the step knows the frequency sqrt(k/m) of a stiff pin: 2/omega is the limit of central differences.
TEST(CompliantJoint, AStepThatCannotStandItsStiffnessIsRefused)
{
  const auto settings = [](double step)
  { return "[run]\nmethod = \"central-difference\"\nend = \"0.01 s\"\nstep = " + number(step) + "\n"; };
  const std::string scene =
      bar("planar", "type = \"revolute\"\nstiffness = 2e6") + "[output.signals]\nF = \"pin.fz\"\n";
  // Along x the bar moves as a mass; across it, at r from the centre, its inertia adds: omega^2 = k/m (1 + m r^2/J).
  const double limit = 2. / std::sqrt(2e6 / 2. * (1. + 2. * 0.4 * 0.4 / 0.5));
  EXPECT_EQ(run(scene + settings(0.98 * limit)).result.failure, "");
  expect_refusal([&] { run(scene + settings(1.02 * limit)); }, "grow");
}

TEST(CompliantJoint, WhatMakesNoCompliantJointIsRefused)
{
  const std::string k = "type = \"revolute\"\nstiffness = \"1 kN/mm\"\n";
  expect_complaint(bar("planar", k + "rotational_stiffness = \"1 N m/rad\""), "constrains no rotation of these bodies");
  expect_complaint(bar("rigid", k + "axis = [0, 1, 0]"), "needs 'rotational_stiffness'");
  expect_complaint(bar("planar", k + "friction = { coefficient = 0.1, radius = \"20 mm\" }"),
                   "is for ideal joints only");
  expect_complaint(bar("planar", "type = \"revolute\"\ndamping = \"1 N s/m\""),
                   "needs 'stiffness' in addition to 'damping'");
  expect_complaint(bar("planar", "type = \"revolute\"\nstiffness = 0"), "constrain nothing");
  expect_complaint(bar("planar", "type = \"revolute\"\nstiffness = [1, -1, 1]"), "zero or more");
  expect_complaint(bar("planar", "type = \"revolute\"\nstiffness = \"-1 N/m\""), "stiffness");
  expect_complaint(bar("planar", "type = \"revolute\"\nstiffness = \"1 N m/rad\""), "needs a stiffness");
  expect_complaint(bar("planar", "type = \"prismatic\"\naxis = [1, 0, 1]\nstiffness = [1, 2, 3]\n"
                                 "rotational_stiffness = 1"),
                   "refer to global axes");
  expect_complaint(bar("planar", k) + "[joint.rod]\ntype = \"distance\"\nfrom = \"ground\"\nto = \"bar\"\nat_from = "
                                      "[1, 0, 0]\nstiffness = 1\n",
                   "of type \"distance\"");
  expect_complaint(bar("planar", k) + "[body.wheel]\ntype = \"rotor\"\naxis = [0, 1, 0]\ninertia = 1\n[joint.gear]\n"
                                      "type = \"gear\"\nfrom = \"bar\"\nto = \"wheel\"\nratio = 2\nstiffness = 1\n",
                   "spring-damper");
}

} // namespace
} // namespace gestell::tests
