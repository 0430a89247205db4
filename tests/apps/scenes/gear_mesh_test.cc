// Wheels whose teeth are in mesh, wherever their centres go: ratios, forces and what is conserved.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::with;

/// A planet of 24 teeth on an arm between a sun of 18 and a ring of 66 teeth: module 10 mm, centres 0.21 m apart.
const std::string planetary =
    rotor_body("sun", "0.02 kg m^2", "[0, 0, 1]", {{"position", "[0, 0, 0]"}}) +
    rotor_body("arm", "0.3 kg m^2", "[0, 0, 1]", {{"position", "[0, 0, 0]"}}) +
    planar_body("planet", "4 kg", "0.03 kg m^2", "['0.21 m', 0, 0]", "[0, 0, 1]") +
    revolute("bolt", "arm", "planet", "['0.21 m', 0, 0]") +
    joint("inner", "gear mesh",
          {{"from", "sun"},
           {"to", "planet"},
           {"axis", "[0, 0, 1]"},
           {"ratio", "-18/24"},
           {"pressure_angle", "-20 deg"}}) +
    joint("outer", "gear mesh",
          {{"from", "planet"},
           {"to", "ground"},
           {"at_to", "[0, 0, 0]"},
           {"axis", "[0, 0, 1]"},
           {"ratio", "24/66"},
           {"pressure_angle", "-20 deg"}}) +
    element("motor", "force", {{"from", "sun"}, {"about", "[0, 0, 1]"}, {"constant", "0.9 N m"}}) +
    steps("0.5 ms", "3 s") +
    signals("sun = 'sun.angle', arm = 'arm.angle', planet = 'planet.angle', inner = 'inner.force', outer = "
            "'outer.force', bx = 'bolt.fx', by = 'bolt.fy'",
            {{"step", "10 ms"}});

TEST(GearMesh, OfAPlanetaryGearFulfilsWillisEquationOverAnyNumberOfTurns)
{
  const SceneRun motion = run(planetary);
  const double   i      = 1. + 66. / 18.; // sun against arm, ring held
  EXPECT_GT(motion.signal("arm").final, 5. * M_PI);
  for (std::size_t row = 0; row < motion.n_rows(); ++row)
  {
    const double arm = motion.at(row, 2);
    ASSERT_NEAR(motion.at(row, 1), i * arm, 1e-11);
    ASSERT_NEAR(motion.at(row, 3), arm - 66. / 24. * arm, 1e-11);
  }
}

// Lagrange's equation of the one degree of freedom, then the balance of every wheel.
TEST(GearMesh, CarriesTheForcesThatTurnEveryWheel)
{
  const double i = 1. + 66. / 18., p = 1. - 66. / 24., R = 0.21;
  const double acceleration = 0.9 * i / (0.02 * i * i + 0.3 + 4. * R * R + 0.03 * p * p);
  // Base radii: of the sun 90 mm cos 20, of the planet 120 mm cos 20.
  const double c = std::cos(M_PI / 9.), inner = (0.9 - 0.02 * i * acceleration) / (0.09 * c),
               outer = (0.03 * p * acceleration + 0.12 * c * inner) / (0.12 * c);
  // How far a run is off: relative; of second order in its step.
  const auto off = [&](const std::string &step)
  {
    const SceneRun motion = run(planetary, {"run.step=" + step});
    const double   arm = motion.signal("arm").final, speed = 3. * acceleration, s = std::sin(M_PI / 9.);
    const double   fx = motion.signal("bx").final, fy = motion.signal("by").final;
    // Of the forces on the planet along the arm, those of the teeth cancel but for their difference times sin 20.
    const double along  = -4. * R * speed * speed - (inner - outer) * s,
                 across = 4. * R * acceleration - (inner + outer) * c;
    return std::array{std::abs(arm / (4.5 * acceleration) - 1.),
                      std::abs(std::abs(motion.signal("inner").final) / inner - 1.),
                      std::abs(std::abs(motion.signal("outer").final) / outer - 1.),
                      std::abs((fx * std::cos(arm) + fy * std::sin(arm)) / along - 1.),
                      std::abs((-fx * std::sin(arm) + fy * std::cos(arm)) / across - 1.),
                      std::abs(motion.result.energy.residual) / (0.9 * i * 4.5 * acceleration)};
  };
  const auto coarse = off("1 ms"), fine = off("0.5 ms");
  for (std::size_t k = 0; k < fine.size(); ++k)
  {
    EXPECT_LT(fine[k], 3e-4) << k;
    EXPECT_LT(fine[k], coarse[k] / 3.) << k;
  }
}

/// Two wheels that nothing but a spring and their teeth hold together.
const std::string free_wheels =
    planar_body("one", "2 kg", "0.01 kg m^2", "[0, 0, 0]") +
    planar_body("two", "3 kg", "0.04 kg m^2", "['0.3 m', 0, '0.4 m']") +
    joint("teeth", "gear mesh",
          {{"from", "one"}, {"to", "two"}, {"axis", "[0, 1, 0]"}, {"ratio", "-0.5"}, {"pressure_angle", "20 deg"}}) +
    measure("distance", "distance", {{"from", "one"}, {"to", "two"}}) +
    element("spring", "formula force", {{"on", "distance"}, {"force", "2 kN/m*(0.5 m - u)"}}) +
    start("v = { 'one.angle' = 20, 'one.ux' = 0.1, 'one.uz' = -0.2, 'two.ux' = 0.3, 'two.uz' = 0.1 }") +
    steps("0.2 ms", "0.5 s") +
    signals("x1 = 'one.ux', z1 = 'one.uz', x2 = 'two.ux', z2 = 'two.uz', vx1 = 'one.vx', vz1 = 'one.vz', vx2 = "
            "'two.vx', vz2 = 'two.vz', w1 = 'one.speed', w2 = 'two.speed', d = 'distance.value'");

TEST(GearMesh, BalancesForcesAndMomentsOnBothBodies)
{
  const SceneRun motion = run(free_wheels);
  const auto     at     = [&](std::size_t row, int i) { return motion.at(row, std::size_t(i)); };
  const auto     moment = [&](std::size_t row) // about y through the origin: z p_x - x p_z, and the spins
  {
    return at(row, 2) * 2. * at(row, 5) - at(row, 1) * 2. * at(row, 6) + (0.4 + at(row, 4)) * 3. * at(row, 7) -
           (0.3 + at(row, 3)) * 3. * at(row, 8) + 0.01 * at(row, 9) + 0.04 * at(row, 10);
  };
  const std::size_t last = motion.n_rows() - 1;
  EXPECT_NEAR(2. * at(last, 5) + 3. * at(last, 7), 2. * at(0, 5) + 3. * at(0, 7), 1e-11);
  EXPECT_NEAR(2. * at(last, 6) + 3. * at(last, 8), 2. * at(0, 6) + 3. * at(0, 8), 1e-11);
  EXPECT_NEAR(moment(last), moment(0), 1e-3 * std::abs(moment(0)));
  EXPECT_GT(motion.signal("d").max - motion.signal("d").min, 0.01); // the centres did move
  expect_closed_balance(motion, 1e-3);
}

// The teeth as a spring with play, on a measure: free over the play, then both turn.
TEST(GearMesh, AsAMeasureTakesASpring)
{
  const SceneRun motion =
      run(rotor_body("one", "0.01 kg m^2", "[0, 0, 1]", {{"position", "[0, 0, 0]"}}) +
          planar_body("two", "1 kg", "0.04 kg m^2", "[0, '0.3 m', 0]", "[0, 0, 1]") +
          revolute("bearing", "ground", "two", "[0, '0.3 m', 0]") +
          measure("teeth", "gear mesh", {{"from", "one"}, {"to", "two"}, {"axis", "[0, 0, 1]"}, {"ratio", "-0.5"}}) +
          element("teeth_spring", "clearance", {{"on", "teeth"}, {"gap", "1 mm"}, {"stiffness", "2 kN/mm"}}) +
          start("v = { one = 1 }") + steps("10 us", "20 ms") + signals("w1 = 'one.speed', w2 = 'two.speed'"));
  EXPECT_NEAR(time_of(motion, "contact_positive"), 1e-3 / 0.1, 1e-9); // the rim of `one`, r = 0.1 m, goes 0.1 m/s
  // Elastic impact of J_1/r_1^2 = 1 kg on J_2/r_2^2 = 1 kg: all the speed is handed over.
  EXPECT_NEAR(motion.signal("w1").final, 0., 1e-3);
  EXPECT_NEAR(std::abs(motion.signal("w2").final), 0.5, 1e-3);
}

// The same gears with elastic teeth: Willis up to their deflection, F/c of some 1e-7 m on radii of 0.1 m.
TEST(GearPair, OnAnArmFollowsItOverAnyNumberOfTurns)
{
  const auto teeth = [](const std::string &name, const std::string &from, const std::string &to, const Keys &radii)
  {
    Keys keys{{"from", from}, {"to", to}, {"axis", "[0, 0, 1]"}, {"stiffness", "100 kN/mm"}, {"damping", "2 kN s/m"}};
    keys.insert(keys.end(), radii.begin(), radii.end());
    return element(name, "gear pair", keys);
  };
  const std::string bodies = planetary.substr(0, planetary.find("[joint.inner]")),
                    rest   = planetary.substr(planetary.find("[element.motor]"));
  const SceneRun motion =
      run(bodies + teeth("inner", "sun", "planet", {{"radius_from", "90 mm"}, {"radius_to", "120 mm"}}) +
          teeth("outer", "planet", "ground",
                {{"at_to", "[0, 0, 0]"}, {"radius_from", "120 mm"}, {"radius_to", "-330 mm"}}) +
          rest);
  EXPECT_GT(motion.signal("arm").final, 5. * M_PI);
  for (std::size_t row = 0; row < motion.n_rows(); ++row)
  {
    const double arm = motion.at(row, 2);
    ASSERT_NEAR(motion.at(row, 1), (1. + 66. / 18.) * arm, 1e-5);
    ASSERT_NEAR(motion.at(row, 3), (1. - 66. / 24.) * arm, 1e-5);
  }
}

TEST(GearMesh, RefusesWhatMakesNoSense)
{
  EXPECT_EQ(test::complaint(planetary), "");
  expect_complaint(with(planetary, "ratio = \"-18/24\"", "ratio = 1"), "must not be 0 or 1");
  expect_complaint(with(planetary, "ratio = \"-18/24\"\n", ""), "the key 'ratio' is missing");
  expect_complaint(with(planetary, "pressure_angle = \"-20 deg\"", "pressure_angle = \"50 deg\""),
                   "between -45 and 45 degrees");
  expect_complaint(with(planetary, "to = \"planet\"\naxis = [0, 0, 1]", "to = \"planet\"\naxis = [0, 1, 0]"),
                   "is not that of 'sun'");
  expect_complaint(with(planetary, "to = \"planet\"\naxis", "to = \"sun\"\naxis"), "is on 'sun', the body of `from`");
  expect_complaint(with(planetary, "from = \"sun\"\nto = \"planet\"", "from = \"sun\"\nto = \"arm\""), "coaxial");
  const std::string planet = "type = \"planar\"\nnormal = [0, 0, 1]\nmass = \"4 kg\"\ninertia = \"0.03 kg m^2\"",
                    rigid  = "type = \"rigid\"\nmass = \"4 kg\"\ninertia = [0.03, 0.03, 0.03]";
  expect_complaint(with(with(planetary, planet, rigid), "\"revolute\"", "\"spherical\""),
                   "whose revolutions are not counted");
}

} // namespace
} // namespace gestell::tests
