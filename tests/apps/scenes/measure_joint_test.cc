// Joints made of measures: cams, screws, rolling wheels, racks, carried gears and prescribed motions, against closed
// forms; and what is refused.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

std::string settings(const std::string &step, const std::string &list, const std::string &end = "1 s")
{
  return steps(step, end) + signals(list);
}

/// Largest distance of a signal from f(t) over the run.
double error(const SceneRun &motion, std::size_t column, const std::function<double(double)> &f)
{
  EXPECT_EQ(motion.result.failure, "");
  double largest = 0.;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
    largest = std::max(largest, std::abs(motion.at(i, column) - f(motion.at(i, 0))));
  return largest;
}

const std::string shaft_and_slide =
    rotor_body("shaft", "0.2 kg m^2", "[0, 1, 0]") + slider_body("slide", "3 kg", "[0, 0, 1]");

// y = e (1 - cos x), x = W t: the contact force is m y'' + c y, the torque of the shaft y'/x' times that.
TEST(Cam, HarmonicCamAtConstantSpeed)
{
  const double e = 0.02, m = 3., c = 5e3, b = 40., W = 12.;
  const auto   scene = [&](const std::string &step)
  {
    const std::string cam =
        element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "5 N/mm"}, {"damping", "40 N s/m"}}) +
        joint("cam", "position function", {{"from", "shaft"}, {"to", "slide"}, {"function", "20 mm*(1 - cos(x))"}}) +
        joint("drive", "prescribed motion", {{"on", "shaft.angle"}, {"motion", "{ speed = '12 rad/s' }"}});
    return run(shaft_and_slide + cam +
               settings(step, "F = \"cam.force\", R = \"cam.reaction\", M = \"drive.torque\", P = \"drive.power\", "
                              "x = \"slide.displacement\""));
  };
  const auto force = [&](double t)
  { return m * e * W * W * std::cos(W * t) + b * e * W * std::sin(W * t) + c * e * (1. - std::cos(W * t)); };
  const auto torque = [&](double t) { return force(t) * e * std::sin(W * t); };
  const auto coarse = scene("2 ms"), fine = scene("1 ms");
  EXPECT_LT(error(fine, 5, [&](double t) { return e * (1. - std::cos(W * t)); }), 1e-14); // positions are exact
  const double of_coarse = error(coarse, 1, force), of_fine = error(fine, 1, force);
  EXPECT_NEAR(order(of_coarse, of_fine), 2., 0.15) << of_fine; // of the speed in the damper
  EXPECT_LT(of_fine, 1e-3 * c * e);
  EXPECT_NEAR(order(error(coarse, 3, torque), error(fine, 3, torque)), 2., 0.15);
  EXPECT_LT(error(fine, 2, [&](double t) { return -torque(t); }), 1e-3 * c * e * e);
  EXPECT_LT(error(fine, 4, [&](double t) { return W * torque(t); }), 1e-3 * W * c * e * e);
  expect_closed_balance(fine, 1e-3);
}

// Free to turn, the cam slows down where the slide is fast: J w^2 + m (e sin x w)^2 is kept.
TEST(Cam, FreeCamKeepsItsEnergyAtTheOrderOfTheMethod)
{
  const auto worst = [&](const std::string &step)
  {
    const std::string cam =
        joint("cam", "position function",
              {{"from", "shaft.angle"}, {"to", "slide.displacement"}, {"function", "0.2 m*(1 - cos(x))"}}) +
        start("v = { shaft = '5 rad/s' }");
    const auto motion  = run(shaft_and_slide + cam +
                             settings(step, "x = \"shaft.angle\", w = \"shaft.speed\", y = \"slide.displacement\""));
    double     largest = 0.;
    for (std::size_t i = 0; i < motion.n_rows(); ++i)
    {
      const double x = motion.at(i, 1), sine = 0.2 * std::sin(x);
      largest = std::max(largest, std::abs(motion.at(i, 2) - 5. * std::sqrt(0.2 / (0.2 + 3. * sine * sine))));
      EXPECT_NEAR(motion.at(i, 3), 0.2 * (1. - std::cos(x)), 1e-13);
    }
    return largest;
  };
  const double coarse = worst("0.2 ms"), fine = worst("0.1 ms");
  EXPECT_NEAR(order(coarse, fine), 2., 0.15) << fine;
}

// A spring on y - f(x) is a compliant cam: at rest its force is that of the load, and natural frequencies hold f'.
TEST(Cam, ElementOnAPositionFunctionActsOnBoth)
{
  const auto motion =
      run(shaft_and_slide +
          measure("gap", "position function",
                  {{"from", "shaft"},
                   {"to", "slide"},
                   {"table", "[['-1 rad', '-50 mm'], ['0 rad', '0 mm'], ['1 rad', '50 mm']]"}}) +
          element("contact", "cubic spring", {{"on", "gap"}, {"cubic", "0"}, {"stiffness", "80 N/mm"}}) +
          "[start]\nq = { slide = \"1 mm\" }\n" +
          settings("20 us", R"(y = "slide.displacement", x = "shaft.angle", s = "gap.value")", "50 ms"));
  // s = y - r x, a free system: m y = 3 - its share; s swings with w^2 = c (1/m + r^2/J).
  const double r = 0.05, m = 3., J = 0.2, c = 8e4, w = std::sqrt(c * (1. / m + r * r / J));
  const double part = (1. / m) / (1. / m + r * r / J);
  EXPECT_LT(error(motion, 3, [&](double t) { return 1e-3 * std::cos(w * t); }), 1e-6);
  EXPECT_LT(error(motion, 1, [&](double t) { return 1e-3 * (1. - part + part * std::cos(w * t)); }), 1e-6);
}

// The last row of a sine is -2.4e-16 where the first is zero: it closes, and the motion is that of a table without it.
TEST(Cam, APeriodicTableMayCloseWithinRounding)
{
  const auto scene = [&](int rows)
  {
    std::string table;
    for (int k = 0; k < rows; ++k)
      table += (k > 0 ? ", [" : "[") + number(k * M_PI / 4.) + ", " + number(0.02 * std::sin(k * M_PI / 4.)) + "]";
    return run(shaft_and_slide +
               joint("cam", "position function",
                     {{"from", "shaft"}, {"to", "slide"}, {"period", "360 deg"}, {"table", "[" + table + "]"}}) +
               joint("drive", "prescribed motion", {{"on", "shaft.angle"}, {"motion", "{ speed = '12 rad/s' }"}}) +
               settings("2 ms", "x = \"slide.displacement\""));
  };
  const auto closed = scene(9), left_out = scene(8);
  EXPECT_LT(error(closed, 1, [&](double t) { return 0.02 * std::sin(12. * t); }), 2e-4); // of the spline, h^4/384
  EXPECT_NEAR(closed.signal("x").final, left_out.signal("x").final, 1e-14);
}

// Backlash of a gear is a clearance on the sum of both rims: free over half the play, then both turn.
TEST(Sum, AClearanceOnItIsTheBacklashOfAGear)
{
  std::string gears;
  for (const std::string name : {"pinion", "wheel"})
    gears += "[body." + name + "]\ntype = \"rotor\"\naxis = [0, 0, 1]\ninertia = \"0.1 kg m^2\"\n";
  const auto motion = run(
      gears +
      measure("mesh", "sum",
              {{"terms", "[{ of = 'pinion', factor = '40 mm' }, { of = 'wheel.angle', factor = '80 mm' }]"}}) +
      element("teeth", "clearance", {{"on", "mesh"}, {"gap", "1 mm"}, {"stiffness", "2 kN/mm"}}) +
      start("v = { pinion = '0.5 rad/s' }") + settings("20 us", "p = \"pinion.speed\", w = \"wheel.speed\"", "0.1 s"));
  EXPECT_NEAR(time_of(motion, "contact_positive"), 1e-3 / (0.04 * 0.5), 1e-10);
  // An elastic blow turns the speed of the mesh round: impulse P = 2 v / (r_1^2/J + r_2^2/J).
  const double P = 2. * 0.04 * 0.5 / ((0.0016 + 0.0064) / 0.1);
  EXPECT_NEAR(motion.signal("p").final, 0.5 - 0.04 * P / 0.1, 1e-4);
  EXPECT_NEAR(motion.signal("w").final, -0.08 * P / 0.1, 1e-4);
}

// Constant forces on constant ratios: the motion is a parabola, which BDF 2 follows to rounding.
TEST(MeasureJoint, ScrewRackAndRollingWheelAccelerateTheirReducedInertia)
{
  const std::string screw =
      joint("screw", "screw", {{"from", "shaft"}, {"to", "slide"}, {"axis", "[0, 0, 1]"}, {"pitch", "-20 mm"}}) +
      element("load", "force", {{"from", "slide"}, {"constant", "90 N"}});
  std::string upright = shaft_and_slide;
  upright.replace(upright.find("[0, 1, 0]"), 9, "[0, 0, 1]");
  const auto nut =
      run(upright + screw + settings("5 ms", R"(z = "slide.displacement", phi = "shaft.angle", F = "screw.force")"));
  const double i = -0.02 / (2. * M_PI), a = 90. / (3. + 0.2 / (i * i));
  EXPECT_LT(error(nut, 1, [&](double t) { return 0.5 * a * t * t; }), 1e-9 * a);
  EXPECT_LT(error(nut, 2, [&](double t) { return -0.5 * a / i * t * t; }),
            1e-9 * a / std::abs(i)); // the nut stays upright
  EXPECT_LT(error(nut, 3, [&](double) { return 3. * a - 90.; }), 1e-7 * 90.);

  const auto rack =
      run(shaft_and_slide +
          joint("rack", "rack", {{"from", "shaft"}, {"to", "slide"}, {"radius", "40 mm"}, {"direction", "[0, 0, 1]"}}) +
          element("motor", "force", {{"from", "shaft"}, {"constant", "6 N m"}}) +
          settings("5 ms", R"(z = "slide.displacement", phi = "shaft.angle", F = "rack.force")"));
  const double rack_a = 6. / 0.04 / (3. + 0.2 / 0.0016);
  EXPECT_LT(error(rack, 1, [&](double t) { return 0.5 * rack_a * t * t; }), 1e-9);
  EXPECT_LT(error(rack, 2, [&](double t) { return 0.5 * rack_a / 0.04 * t * t; }), 1e-9);
  EXPECT_LT(error(rack, 3, [&](double) { return 3. * rack_a; }), 1e-7);

  const auto wheel =
      run("gravity = ['3 m/s^2', 0, '-9 m/s^2']\n" + planar_body("wheel", "4 kg", "0.1 kg m^2", "[0, 0, '0.2 m']") +
          joint("track", "in-plane", "ground", "wheel", "[0, 0, '0.2 m']", {{"axis", "[0, 0, 1]"}}) +
          joint("grip", "rolling", {{"from", "wheel"}, {"radius", "0.2 m"}, {"direction", "[1, 0, 0]"}}) +
          settings("5 ms", R"(x = "wheel.ux", phi = "wheel.angle", F = "grip.force")"));
  const double wheel_a = 3. / (1. + 0.1 / (4. * 0.04));
  EXPECT_LT(error(wheel, 1, [&](double t) { return 0.5 * wheel_a * t * t; }), 1e-9);
  EXPECT_LT(error(wheel, 2, [&](double t) { return 0.5 * wheel_a / 0.2 * t * t; }), 1e-9);
  EXPECT_LT(error(wheel, 3, [&](double) { return 4. * (wheel_a - 3.); }), 1e-7);
}

// Sun 20 teeth, ring 60 teeth and held: the carrier turns at a quarter of the speed of the sun.
TEST(MeasureJoint, AGearOnACarrierThatTurnsFulfilsWillisEquation)
{
  std::string bodies;
  for (const std::string name : {"sun", "ring", "arm"})
    bodies += "[body." + name + "]\ntype = \"rotor\"\naxis = [0, 0, 1]\ninertia = \"1 kg m^2\"\n";
  const auto motion = run(
      bodies + joint("planets", "gear", {{"from", "sun"}, {"to", "ring"}, {"ratio", "-20/60"}, {"carrier", "arm"}}) +
      joint("hold", "prescribed motion", {{"on", "ring.angle"}, {"motion", "{ speed = 0 }"}}) +
      joint("drive", "prescribed motion", {{"on", "sun.angle"}, {"motion", "{ function = '3*t^2/s^2' }"}}) +
      settings("5 ms", R"(arm = "arm.angle", M = "drive.torque", H = "hold.torque")"));
  EXPECT_LT(error(motion, 1, [](double t) { return 0.75 * t * t; }), 1e-9);
  EXPECT_LT(error(motion, 2, [](double) { return 6. + 1.5 / 4.; }), 1e-7); // sun, and the arm reduced to it
  // All torques of the three shafts together turn all three: 6 + 0 + 1.5.
  EXPECT_LT(error(motion, 3, [](double) { return 1.5 * 0.75; }), 1e-7);
}

TEST(PrescribedMotion, FormulaTableAndProfileAreFollowedWithTheTorqueTheyNeed)
{
  const auto driven = [](const std::string &motion, const std::string &step)
  {
    return run(rotor(0.2, "1 s") +
                   "[element.bearing]\ntype = \"spring-damper\"\nfrom = \"shaft\"\ndamping = \"3 N m s/rad\"\n"
                   "[joint.drive]\ntype = \"prescribed motion\"\non = \"shaft.angle\"\nmotion = { " +
                   motion + " }\n",
               {"run.step=" + step, "output.picture_step=0", "output.signals.M=drive.torque"});
  };
  // The angle is exact, the torque of inertia too; that of the damper follows the speed at the order of the method.
  const std::string formula = "function = \"0.5 rad*sin(7 rad/s*t)\"";
  const auto        torque  = [](double t) { return -0.2 * 24.5 * std::sin(7. * t) + 3. * 3.5 * std::cos(7. * t); };
  const auto        coarse = driven(formula, "4 ms"), fine = driven(formula, "2 ms");
  EXPECT_LT(error(fine, 2, [](double t) { return 0.5 * std::sin(7. * t); }), 1e-14);
  EXPECT_NEAR(order(error(coarse, 3, torque), error(fine, 3, torque)), 2., 0.15);
  expect_closed_balance(fine, 1e-3);

  // To 4 rad/s with 10 rad/s^2 and 100 rad/s^3: 0.1 s + 0.3 s + 0.1 s; four corners.
  const auto ramp = driven(
      "speed = [{ at = \"0.2 s\", to = \"4 rad/s\", acceleration = \"10 rad/s^2\", jerk = \"100 rad/s^3\" }]", "1 ms");
  EXPECT_EQ(count(ramp, "next_segment"), 4);
  EXPECT_NEAR(ramp.signal("phi").final, 4. * 0.25 + 4. * 0.3, 1e-12); // half the speed over 0.5 s, then 0.3 s
  EXPECT_NEAR(ramp.signal("M").final, 12., 1e-6);

  // A table from rest to rest, and on beyond its end: an event, with the slope of the end.
  const auto table =
      driven("table = [[\"0 s\", 0], [\"0.2 s\", \"0.1 rad\"], [\"0.4 s\", \"0.4 rad\"], [\"0.6 s\", \"0.9 rad\"]]",
             "1 ms"); // a parabola, 2.5 t^2
  EXPECT_EQ(count(table, "table_ends"), 1);
  EXPECT_NEAR(table.signal("phi").final, 0.9 + 3. * 0.4, 1e-9);
}

// The frame is shaken by a prescribed motion of its foot: the force is what its mass and the rest demand.
TEST(PrescribedMotion, OfTheFrame)
{
  const std::string shaken = R"([frame]
mass = [["2 kg", 0], [0, "5 kg"]]
stiffness = [["8 kN/m", "-8 kN/m"], ["-8 kN/m", "8 kN/m"]]
[frame.interface.foot]
rows = { ux = 1 }
[frame.interface.head]
rows = { ux = 2 }
)" + joint("shaker", "prescribed motion",
           {{"on", "frame.foot.ux"}, {"motion", "{ function = '1 mm*(1 - cos(15 rad/s*t))' }"}});
  const auto        motion = run(shaken + settings("0.2 ms", "F = \"shaker.force\", head = \"frame.head.ux\""));
  const double      w = 40., W = 15., x = 1e-3, A = w * w / (w * w - W * W); // head: 5 x'' + 8000 x = 8000 foot
  const auto        head = [&](double t) { return x * (1. - A * std::cos(W * t) + (A - 1.) * std::cos(w * t)); };
  EXPECT_LT(error(motion, 2, head), 1e-3 * x);
  EXPECT_LT(error(motion, 1,
                  [&](double t)
                  {
                    const double foot = x * (1. - std::cos(W * t));
                    return 2. * x * W * W * std::cos(W * t) + 8e3 * (foot - head(t));
                  }),
            1e-3 * 8e3 * x);
}

// The natural spline through a step of height 1 swings by 7 to 9 % beyond its level parts; the same rise in a
// sine has its extremes where the steps change their sign, and no level part.
TEST(Cam, TableWhoseSplineSwingsBeyondItsRowsGivesAWarning)
{
  const auto warnings = [&](const std::string &rows, const std::string &period = "0")
  {
    Keys cam = {{"from", "shaft"}, {"to", "slide"}, {"table", "[" + rows + "]"}};
    if (period != "0")
      cam.push_back({"period", period});
    return test::scene_of(shaft_and_slide + joint("cam", "position function", cam)).warnings;
  };
  const auto step = warnings("[0, 0], [1, 0], [2, 0], [3, 1], [4, 1], [5, 1]");
  EXPECT_NE(step.at(0).find("scene.toml:13: joint.cam.table: the spline overshoots"), std::string::npos) << step[0];
  const auto level = warnings("[0, 0], [0.9, 0], [1, 0], [1.01, 1], [1.1, 1], [2, 1]"); // uneven rows
  EXPECT_NE(level.at(0).find("overshoots by 133 the adjacent rows at 1.6"), std::string::npos) << level[0];
  std::string sine;
  for (int i = 0; i < 12; ++i)
    sine +=
        (i ? ", [" : "[") + std::to_string(i * M_PI / 6.) + ", " + std::to_string(std::sin(0.1 + i * M_PI / 6.)) + "]";
  EXPECT_TRUE(warnings(sine, "360 deg").empty());
  EXPECT_TRUE(warnings("[0, 0], [1, 1], [2, 3], [3, 4]").empty());
}

// An ideal joint would make masses jump, with energy from nowhere; what only bends is followed.
TEST(PrescribedMotion, AJumpOfTheSpeedEndsTheRun)
{
  const auto driven = [](const std::string &function)
  {
    return stopped(rotor(0.2, "1 s") +
                       "[joint.drive]\ntype = \"prescribed motion\"\non = \"shaft.angle\"\nmotion = { "
                       "function = \"" +
                       function + "\" }\n",
                   {"run.step=10 ms", "output.picture_step=0"});
  };
  const std::string failure = driven("if(t < 0.305 s, 0, 2*(t - 0.305 s)/s)").result.failure;
  EXPECT_NE(
      failure.find("at t = 0.305 s, \"drive\": the speed of the prescribed motion jumps from 0 to 2 (if_1_rises)"),
      std::string::npos)
      << failure;
  EXPECT_NE(failure.find("through a spring"), std::string::npos) << failure;
  EXPECT_NE(driven("0.1*step(t - 0.305 s)").result.failure.find("the prescribed motion jumps from 0 to 0.1"),
            std::string::npos);
  const auto smooth = driven("if(t < 0.305 s, 0, 2*((t - 0.305 s)/s)^2)");
  EXPECT_NEAR(smooth.signal("phi").final, 2. * 0.695 * 0.695, 1e-9);
}

TEST(Cam, AKinkOfItsCourseEndsTheRun)
{
  const auto cam = [](const std::string &function)
  {
    return stopped(shaft_and_slide +
                   "[start]\nq = { shaft = -0.5 }\nv = { shaft = 2 }\n[joint.cam]\ntype = \"position "
                   "function\"\nfrom = \"shaft\"\nto = \"slide\"\nfunction = \"" +
                   function + "\"\n" + settings("1 ms", "phi = \"shaft.angle\""));
  };
  const auto kink = cam("20 mm*abs(x)");
  EXPECT_NE(kink.result.failure.find("the slope of the position function jumps from -0.02 to 0.02 (abs_1_rises)"),
            std::string::npos)
      << kink.result.failure;
  EXPECT_NEAR(kink.signal("phi").final, 0., 1e-9) << "it ends at the kink";
  EXPECT_EQ(cam("20 mm*x*abs(x)").result.failure, "");
}

// Of a periodic one it is known before: rise and fall in straight lines, in sines, and one that ends short of a turn.
TEST(Cam, AKinkOfAPeriodicCourseIsRefusedWithItsPlace)
{
  const auto said = [](const std::string &function)
  {
    return test::complaint(shaft_and_slide +
                           "[joint.cam]\ntype = \"position function\"\nfrom = \"shaft\"\nto = "
                           "\"slide\"\nperiod = \"360 deg\"\nfunction = \"" +
                           function + "\"\n");
  };
  const std::string straight =
      said("if(x < 90 deg, 40 mm*x/(90 deg), if(x < 180 deg, 40 mm*(180 deg - x)/(90 deg), 0))");
  EXPECT_NE(straight.find("joint.cam.function: the slope jumps from 0 to 0.0254648 at 0 deg (next_period)"),
            std::string::npos)
      << straight;
  EXPECT_EQ(said("if(x < 180 deg, 20 mm*(1 - cos(2*x)), 0)"), "");
  const std::string short_of = said("if(x < 170 deg, 20 mm*(1 - cos(2*x)), 0)");
  EXPECT_NE(short_of.find("the value jumps from 0.00120615 to 0 at 170 deg (if_1_"), std::string::npos) << short_of;
}

TEST(MeasureJoint, BadInputIsReportedWithItsPlace)
{
  const auto        joint = [](const std::string &keys) { return shaft_and_slide + "[joint.j]\n" + keys; };
  const std::string cam   = "type = \"position function\"\nfrom = \"shaft\"\n";
  expect_complaint(joint(cam + "to = \"slide\"\nfunction = \"20 mm*sin(y)\"\n"), "scene.toml:13: joint.j.function: ");
  expect_complaint(joint(cam + "to = \"slide\"\nfunction = \"20 mm*sin(y)\"\n"), "character 11");
  expect_complaint(joint(cam + "to = \"slide\"\nfunction = \"20 N*sin(x)\"\n"), "needs a length");
  expect_complaint(joint(cam + "to = \"shaft\"\nfunction = \"x\"\n"), "the same as `from`");
  expect_complaint(joint(cam + "to = \"slid\"\nfunction = \"1 m*x\"\n"), "did you mean 'slide'");
  expect_complaint(joint(cam + "to = \"slide\"\n"), "needs either 'function'");
  expect_complaint(joint(cam + "to = \"slide\"\nfunction = \"1 mm*x\"\nperiod = \"360 deg\"\n"),
                   "value at the end of the period");
  expect_complaint(joint(cam + "to = \"slide\"\ntable = [[0, 0], [2, 1], [1, 2]]\n"), "row 3, abscissa = 1");
  expect_complaint(joint(cam + "to = \"slide\"\ntable = [[0, 0], [\"1 mm\", 1], [2, 2]]\n"), "needs an angle");
  expect_complaint(joint(cam + "to = \"slide\"\nperiod = 3\ntable = [[0, 0], [2, 1], [3, 2]]\n"), "does not close");
  expect_complaint(joint(cam + "to = \"slide\"\nperiod = 3\ntable = [[0, 0], [2, 1], [3, 1e-8]]\n"), "does not close");
  expect_complaint(joint("type = \"screw\"\nfrom = \"shaft\"\nto = \"slide\"\naxis = [0, 0, 1]\npitch = \"1 mm\"\n"),
                   "does not rotate about");
  expect_complaint(
      joint("type = \"rack\"\nfrom = \"shaft\"\nto = \"slide\"\nradius = \"1 m\"\ndirection = [0, 1, 0]\n"),
      "must be perpendicular to the axis");
  expect_complaint(
      joint("type = \"rack\"\nfrom = \"slide\"\nto = \"shaft\"\nradius = \"1 m\"\ndirection = [0, 1, 0]\n"),
      "not a rotor");
  expect_complaint(
      joint("type = \"rack\"\nfrom = \"shaft\"\nto = \"slide\"\nradius = \"1 m\"\ndirection = [1, 0, 0]\n"),
      "neither 'shaft' nor 'slide' can move along it"); // the slide moves along z
  expect_complaint(joint("type = \"rolling\"\nfrom = \"shaft\"\nradius = \"1 m\"\ndirection = [1, 0, 0]\n"),
                   "make the wheel a planar body");
  expect_complaint(joint("type = \"prescribed motion\"\non = \"shaft.angle\"\nmotion = { speed = \"1 m/s\" }\n"),
                   "angular speed");
  expect_complaint(
      joint("type = \"prescribed motion\"\non = \"shaft.angle\"\nmotion = { speed = [{ at = 0, to = 1 }] }\n"),
      "jump of the speed");
  const std::string sum =
      shaft_and_slide + "[measure.m]\ntype = \"sum\"\nterms = [{ of = \"slide\" }, { of = \"shaft\"";
  expect_complaint(sum + " }]\n", "all terms must be lengths");
  EXPECT_EQ(test::complaint(sum + ", factor = \"-40 mm\" }]\n"), "");
}

} // namespace
} // namespace gestell::tests
