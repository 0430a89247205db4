// Belts, chains, gear pairs and rolling bearings: closed forces, what is conserved, what the bearings carry, the same
// machine seen from elsewhere.

#include "apps/scene/file/scene_file.h"
#include "tests/support/moved_scene.h"
#include "tests/support/other_units.h"
#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::tests
{
namespace
{

using test::with;

const Keys belt_keys{{"from", "one"},          {"to", "two"},           {"axis", "[0, 1, 0]"},
                     {"radius_from", "60 mm"}, {"radius_to", "150 mm"}, {"damping", "50 N s/m"},
                     {"stiffness", "80 N/mm"}, {"pretension", "400 N"}};
const Keys gear_keys{{"from", "one"},          {"to", "two"},          {"axis", "[0, 1, 0]"},
                     {"radius_from", "0.2 m"}, {"radius_to", "0.3 m"}, {"damping", "500 N s/m"},
                     {"stiffness", "5 kN/mm"}, {"backlash", "0.2 mm"}};

std::string belt(const Keys &more = {})
{
  Keys keys = belt_keys;
  keys.insert(keys.end(), more.begin(), more.end());
  return element("drive", "belt", keys);
}

std::string gears(const Keys &more = {})
{
  Keys keys = gear_keys;
  keys.insert(keys.end(), more.begin(), more.end());
  return element("drive", "gear pair", keys);
}

/// Two wheels in the plane of x and z, 0.5 m apart.
const std::string wheels = planar_body("one", "2 kg", "0.01 kg m^2", "[0, 0, 0]") +
                           planar_body("two", "3 kg", "0.04 kg m^2", "['0.3 m', 0, '0.4 m']");

const std::string bearings =
    "gravity = [0, 0, -9.81]\n" + wheels +
    revolute("b1", "ground", "one", "[0, 0, 0]", {{"stiffness", "2 kN/mm"}, {"damping", "200 N s/m"}}) +
    revolute("b2", "ground", "two", "['0.3 m', 0, '0.4 m']", {{"stiffness", "3 kN/mm"}, {"damping", "200 N s/m"}});

const std::string exact_run =
    table("run", {{"method", "exact"}, {"tolerance", "1e-10"}, {"step", "1 ms"}, {"end", "0.2 s"}});

const std::string all_signals = signals(
    "x1 = 'one.ux', z1 = 'one.uz', x2 = 'two.ux', z2 = 'two.uz', vx1 = 'one.vx', vz1 = 'one.vz', vx2 = 'two.vx', "
    "vz2 = 'two.vz', w1 = 'one.speed', w2 = 'two.speed', ax1 = 'one.ax', az1 = 'one.az', ax2 = 'two.ax', az2 = "
    "'two.az', a1 = 'one.acceleration', a2 = 'two.acceleration'",
    {{"step", "0.5 ms"}});

std::string more_signals(const std::string &text, const std::string &list)
{
  return with(text, "signals = { ", "signals = { " + test::quoted(list) + ", ");
}

/// A drive and its tangents: pulls of both, on the circles that they touch.
struct Tangents
{
  std::string drive;
  double      r_1, r_2; ///< signed: of two signs they cross
  double      sense;    ///< -1: they push
  std::array<double, 2> (*loads)(const SceneRun &motion, std::size_t row);
};

std::array<double, 2> pulls(const SceneRun &motion, std::size_t row)
{
  return {motion.at(row, motion.column("FL")), motion.at(row, motion.column("FR"))};
}

std::array<double, 2> pushes(const SceneRun &motion, std::size_t row)
{
  const double F = motion.at(row, motion.column("F"));
  return {std::max(F, 0.), std::max(-F, 0.)};
}

std::vector<Tangents> drives()
{
  const double base = std::cos(M_PI / 9.);
  return {{belt(), 0.06, 0.15, 1., pulls},
          {belt({{"crossed", "true"}}), 0.06, -0.15, 1., pulls},
          {gears(), 0.2 * base, -0.3 * base, -1., pushes}};
}

std::string strands_or_force(const Tangents &drive)
{
  return drive.sense > 0. ? "FL = 'drive.left_force', FR = 'drive.right_force', H = 'drive.hub_force'"
                          : "F = 'drive.force', Ft = 'drive.tangential_force', Fr = 'drive.radial_force'";
}

/// Force on the first wheel along x and z, and torque about its axis and that of the second one.
struct Load
{
  Eigen::Vector2d force;
  double          torque_1, torque_2;
};

Load load_of(const Tangents &drive, const SceneRun &motion, std::size_t row)
{
  const auto            at = [&](const char *name) { return motion.at(row, motion.column(name)); };
  const Eigen::Vector2d d(0.3 + at("x2") - at("x1"), 0.4 + at("z2") - at("z1")), e = d.normalized(), left(e[1], -e[0]);
  const double          D = d.norm(), circles = drive.r_1 - drive.r_2;
  const auto            F = drive.loads(motion, row);
  Load                  load{{0., 0.}, 0., 0.};
  for (const double side : {1., -1.})
  {
    const double pull = drive.sense * F[side > 0. ? 0 : 1];
    load.force += pull * (std::sqrt(D * D - circles * circles) / D * e - side * circles / D * left);
    load.torque_1 -= side * pull * drive.r_1;
    load.torque_2 += side * pull * drive.r_2;
  }
  return load;
}

// Newton and Euler for either wheel at every instant, while the centres vibrate.
TEST(BeltsAndGears, LoadTheBearingsAlongTheirTangentsWhereverTheCentresAre)
{
  for (const Tangents &drive : drives())
  {
    const SceneRun motion =
        run(bearings + drive.drive +
            element("load", "force",
                    {{"from", "two"},
                     {"about", "[0, 1, 0]"},
                     {"constant", "20 N m"},
                     {"harmonics", "[{ amplitude = '60 N m', frequency = '15 Hz' }]"}}) +
            element("brake", "spring-damper", {{"from", "one"}, {"about", "[0, 1, 0]"}, {"damping", "1 N m s/rad"}}) +
            start("v = { 'one.angle' = 20, 'one.ux' = 0.5, 'two.uz' = -0.3 }") + exact_run +
            more_signals(all_signals,
                         strands_or_force(drive) +
                             ", fx1 = 'b1.fx', fz1 = 'b1.fz', fx2 = 'b2.fx', fz2 = 'b2.fz', M = 'load.torque', "
                             "B = 'brake.torque'"));
    double largest = 0., off = 0., moved = 0.;
    for (std::size_t row = 0; row < motion.n_rows(); ++row)
    {
      const auto            at   = [&](const char *name) { return motion.at(row, motion.column(name)); };
      const Load            load = load_of(drive, motion, row);
      const Eigen::Vector2d g(0., -9.81);
      const Eigen::Vector2d on_1 = load.force + Eigen::Vector2d(at("fx1"), at("fz1")) + 2. * g -
                                   2. * Eigen::Vector2d(at("ax1"), at("az1")),
                            on_2 = -load.force + Eigen::Vector2d(at("fx2"), at("fz2")) + 3. * g -
                                   3. * Eigen::Vector2d(at("ax2"), at("az2"));
      largest = std::max(largest, load.force.norm());
      off     = std::max({off, on_1.norm(), on_2.norm(), std::abs(load.torque_1 - at("B") - 0.01 * at("a1")),
                          std::abs(load.torque_2 + at("M") - 0.04 * at("a2"))});
      moved   = std::max(moved, std::abs(at("x1")));
      if (drive.sense > 0.)
      {
        EXPECT_NEAR(at("H"), load.force.norm(), 1e-9 * 400.);
      }
      else
      {
        EXPECT_NEAR(std::hypot(at("Ft"), at("Fr")), load.force.norm(), 1e-9 * 400.);
      }
    }
    EXPECT_GT(largest, 400.) << drive.drive;
    EXPECT_LT(off, 1e-9 * largest) << drive.drive;
    EXPECT_GT(moved, 2e-4) << drive.drive;
    expect_closed_balance(motion, 1e-8);
  }
}

// Two wheels that nothing else holds: momentum, moment of momentum and energy.
TEST(BeltsAndGears, ConserveWhatInnerForcesCannotChange)
{
  for (const Tangents &drive : drives())
  {
    const SceneRun motion =
        run(wheels + drive.drive + measure("distance", "distance", {{"from", "one"}, {"to", "two"}}) +
            element("spring", "formula force", {{"on", "distance"}, {"force", "20 kN/m*(0.52 m - u)"}}) +
            start("v = { 'one.angle' = 20, 'one.ux' = 0.1, 'one.uz' = -0.2, 'two.ux' = 0.3, 'two.uz' = 0.1 }") +
            exact_run + all_signals);
    const auto moment = [&](std::size_t row)
    {
      const auto at = [&](const char *name) { return motion.at(row, motion.column(name)); };
      return 2. * (at("z1") * at("vx1") - at("x1") * at("vz1")) +
             3. * ((0.4 + at("z2")) * at("vx2") - (0.3 + at("x2")) * at("vz2")) + 0.01 * at("w1") + 0.04 * at("w2");
    };
    const std::size_t last = motion.n_rows() - 1;
    const auto        at   = [&](const char *name) { return motion.at(last, motion.column(name)); };
    EXPECT_NEAR(2. * at("vx1") + 3. * at("vx2"), 1.1, 1e-9);
    EXPECT_NEAR(2. * at("vz1") + 3. * at("vz2"), -0.1, 1e-9);
    EXPECT_NEAR(moment(last), moment(0), 1e-9) << drive.drive;
    expect_closed_balance(motion, 1e-8);
  }
}

/// A rotor that a torsional spring holds, driven by a torque on another one through `drive`; at rest.
std::string held(const std::string &drive, const std::string &torque, const std::string &list)
{
  return rotor_body("one", "0.01 kg m^2", "[0, 1, 0]") +
         rotor_body("two", "0.04 kg m^2", "[0, 1, 0]", {{"position", "['0.5 m', 0, 0]"}}) + drive +
         element("hold", "spring-damper", {{"from", "one"}, {"stiffness", "1000 N m/rad"}}) +
         element("load", "force", {{"from", "two"}, {"about", "[0, 1, 0]"}, {"constant", torque}}) +
         start("rule = 'static'") + steps("1 ms", "2 ms") + signals(list);
}

TEST(Belt, AtRestHasThePullsOfItsTorque)
{
  for (const bool crossed : {false, true})
  {
    const SceneRun motion =
        run(held(belt({{"crossed", crossed ? "true" : "false"}}), "30 N m",
                 "FL = 'drive.left_force', FR = 'drive.right_force', H = 'drive.hub_force', M = 'hold.torque'"));
    // The torque turns `two` positively; the strand that it stretches is the right one, of a crossed belt the left.
    const double half = 0.5 * 30. / 0.15, right = 400. + (crossed ? -half : half), left = 800. - right,
                 sine = (crossed ? 0.21 : 0.09) / 0.5;
    EXPECT_NEAR(motion.at(0, motion.column("FL")), left, 1e-9 * 400.);
    EXPECT_NEAR(motion.at(0, motion.column("FR")), right, 1e-9 * 400.);
    EXPECT_NEAR(motion.at(0, motion.column("H")), std::hypot(800. * std::sqrt(1. - sine * sine), 2. * half * sine),
                4e-7);
    EXPECT_NEAR(std::abs(motion.at(0, motion.column("M"))), 30. * 0.06 / 0.15, 1e-9 * 12.);
  }
}

// With one strand slack the other takes all of the torque.
TEST(Chain, LeavesItsSlackStrandWithoutForce)
{
  const SceneRun motion = run(held(element("drive", "chain",
                                           {{"from", "one"},
                                            {"to", "two"},
                                            {"axis", "[0, 1, 0]"},
                                            {"pitch", "12.7 mm"},
                                            {"teeth_from", "17"},
                                            {"teeth_to", "38"},
                                            {"stiffness", "2 kN/mm"},
                                            {"pretension", "20 N"}}),
                                   "-30 N m", "FL = 'drive.left_force', FR = 'drive.right_force'"));
  const double   r      = 38. * 0.0127 / (2. * M_PI);
  EXPECT_NEAR(motion.at(0, motion.column("FL")), 30. / r, 1e-9 * 30. / r);
  EXPECT_EQ(motion.at(0, motion.column("FR")), 0.);
}

// E A times the strain of the whole belt; a longer one hangs.
TEST(Belt, OfALengthHasThePullOfItsStrain)
{
  const double      path  = 2. * 0.5 + 2. * M_PI * 0.1;
  const std::string equal = element("drive", "belt",
                                    {{"from", "one"},
                                     {"to", "two"},
                                     {"axis", "[0, 1, 0]"},
                                     {"radius_from", "0.1 m"},
                                     {"radius_to", "0.1 m"},
                                     {"rigidity", "50 kN"},
                                     {"length", "1.62 m"}});
  const std::string list  = "FL = 'drive.left_force', FR = 'drive.right_force'";
  const SceneRun    taut  = run(held(equal, "0 N m", list)),
                 slack    = run(held(with(equal, "1.62 m", "1.63 m"), "0 N m", list));
  for (const char *strand : {"FL", "FR"})
  {
    EXPECT_NEAR(taut.at(0, taut.column(strand)), 5e4 * (path - 1.62) / 1.62, 1e-9 * 260.);
    EXPECT_EQ(slack.at(0, slack.column(strand)), 0.);
  }
}

/// The first gear on an interface that yields in all six directions, the second one on the ground.
std::string on_frame(const Keys &teeth, const std::string &torque)
{
  return table(
             "frame",
             {{"mass", "[[9, 0, 0, 0, 0, 0], [0, 9, 0, 0, 0, 0], [0, 0, 9, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, "
                       "1, 0], [0, 0, 0, 0, 0, 1]]"},
              {"stiffness", "[[1e9, 0, 0, 0, 0, 0], [0, 2e9, 0, 0, 0, 0], [0, 0, 3e9, 0, 0, 0], [0, 0, 0, 4e9, "
                            "0, 0], [0, 0, 0, 0, 5e9, 0], [0, 0, 0, 0, 0, 6e9]]"}}) +
         table("frame.interface.seat",
               {{"rows", "{ ux = 1, uy = 2, uz = 3, rx = 4, ry = 5, rz = 6 }"}, {"position", "[0, 0, 0]"}}) +
         rotor_body("one", "0.01 kg m^2", "[0, 1, 0]", {{"on", "frame.seat"}}) +
         rotor_body("two", "0.04 kg m^2", "[0, 1, 0]", {{"position", "['0.5 m', 0, 0]"}}) + gears(teeth) +
         element("hold", "spring-damper", {{"from", "one"}, {"to", "ground"}, {"stiffness", "1e7 N m/rad"}}) +
         element("load", "force", {{"from", "two"}, {"about", "[0, 1, 0]"}, {"constant", torque}}) +
         start("rule = 'static'") + steps("1 ms", "2 ms") +
         signals(
             "F = 'drive.force', Ft = 'drive.tangential_force', Fr = 'drive.radial_force', Fa = 'drive.axial_force', "
             "ux = 'frame.seat.ux', uy = 'frame.seat.uy', uz = 'frame.seat.uz', rx = 'frame.seat.rx', rz = "
             "'frame.seat.rz'");
}

// F_t = M/r, F_r = F_t tan(alpha_n)/cos(beta), F_a = F_t tan(beta), F = F_t/(cos(alpha_n) cos(beta)); the axial force
// of a right-handed driver points along its rotation, as the thumb of a right hand does.
TEST(GearPair, LoadsItsBearingsByPressureAndHelixAngle)
{
  const double alpha = M_PI / 9., beta = M_PI / 12.;
  for (const double hand : {1., -1.})
    for (const double sense : {1., -1.}) // of the torque on the second gear
    {
      const SceneRun motion =
          run(on_frame({{"helix_angle", number(15. * hand) + " deg"}}, number(sense * 300.) + " N m"));
      const auto at = [&](const char *name) { return motion.at(0, motion.column(name)); };
      // The gears yield by x = 7.5e-7 of their distance, by which the radial force grows by x/tan(alpha) of F_t.
      const double Ft = 1000., near = 3e-6;
      EXPECT_NEAR(at("Ft"), -sense * Ft, near * Ft);
      EXPECT_NEAR(at("F"), -sense * Ft / (std::cos(alpha) * std::cos(beta)), near * Ft);
      EXPECT_NEAR(at("Fr"), Ft * std::tan(alpha) / std::cos(beta), near * Ft);
      EXPECT_NEAR(at("Fa"), -sense * hand * Ft * std::tan(beta), near * Ft);
      // On the first gear: away from the second one, against Fa, and against F_t at the pitch point on `two`.
      EXPECT_NEAR(at("ux") * 1e9, -at("Fr"), near * Ft);
      EXPECT_NEAR(at("uy") * 2e9, -at("Fa"), near * Ft);
      EXPECT_NEAR(at("uz") * 3e9, -at("Ft"), near * Ft);
      EXPECT_NEAR(at("rx") * 4e9, 0., near * Ft);
      EXPECT_NEAR(at("rz") * 6e9, -0.2 * at("Fa"), near * Ft);
    }
}

// Free over half of the backlash, then an elastic impact of equal masses on the base circles.
TEST(GearPair, WithBacklashHandsOverItsSpeedByAnImpact)
{
  const double   base = 0.2 * std::cos(M_PI / 9.), J = 2. * base * base;
  const SceneRun motion = run(rotor_body("one", number(J), "[0, 1, 0]") +
                              rotor_body("two", number(J * 2.25), "[0, 1, 0]", {{"position", "['0.5 m', 0, 0]"}}) +
                              with(gears(), "damping = \"500 N s/m\"\n", "") + start("v = { one = -1 }") +
                              steps("1 us", "2.5 ms") + signals("w1 = 'one.speed', w2 = 'two.speed'"));
  EXPECT_NEAR(time_of(motion, "left_contact"), 1e-4 / base, 1e-9);
  EXPECT_EQ(count(motion, "left_separation"), 1);
  EXPECT_NEAR(motion.signal("w1").final, 0., 1e-4);
  EXPECT_NEAR(motion.signal("w2").final, 1. / 1.5, 1e-4);
}

// A ring is turned in the sense of its pinion, whose teeth pull it to the rim.
TEST(GearPair, WithARingTurnsBothInOneSense)
{
  const std::string pair =
      with(with(gears({{"pressure_angle", "25 deg"}}), "radius_to = \"0.3 m\"", "radius_to = \"-0.7 m\""),
           "backlash = \"0.2 mm\"\n", "");
  const SceneRun motion = run(held(pair, "-70 N m", "F = 'drive.force', Fr = 'drive.radial_force', M = 'hold.torque'"));
  const double   cosine = std::cos(25. * M_PI / 180.);
  EXPECT_NEAR(motion.at(0, motion.column("F")), 100. / cosine, 1e-9 * 100.);
  EXPECT_NEAR(motion.at(0, motion.column("Fr")), 100. * std::sqrt(1. / (cosine * cosine) - 1.), 1e-7);
  EXPECT_NEAR(motion.at(0, motion.column("M")), -20., 2e-8);
}

/// Both drives at once, between bodies that are free to move.
const std::string both =
    bearings + belt() + with(gears(), "[element.drive]", "[element.teeth]") +
    element("load", "force", {{"from", "two"}, {"about", "[0, 1, 0]"}, {"constant", "20 N m"}}) +
    start("v = { 'one.angle' = 20, 'one.ux' = 0.5, 'two.uz' = -0.3 }") +
    table("run", {{"method", "bdf"}, {"step", "50 us"}, {"end", "20 ms"}, {"newton_tolerance", "1e-13"}}) +
    signals("L = 'drive.left_force', R = 'drive.right_force', H = 'drive.hub_force', F = 'teeth.force', T = "
            "'teeth.radial_force', w1 = 'one.speed', w2 = 'two.speed', u = 'one.ux'");

TEST(BeltsAndGears, AreTheSameSeenFromElsewhereAndInAMirror)
{
  const test::SceneFolder folder;
  const std::string       path     = folder.write("scene.toml", both);
  const apps::SceneNode   tree     = apps::read_scene_file(path, {});
  const auto              original = run_of(tree, path);
  ASSERT_EQ(original.failure, "");
  for (const bool mirrored : {false, true})
  {
    RigidMotion motion;
    motion.R = random_rotation(7);
    if (mirrored)
      motion.R.col(0) *= -1.;
    motion.shift         = {0.3, -0.2, 0.5};
    const Restated other = moved(tree, motion);
    const auto     seen  = run_of(other.scene, path);
    ASSERT_EQ(seen.failure, "");
    const Deviation worst = largest_deviation(original, seen, other.signals);
    EXPECT_LT(worst.value, 1e-8) << worst.signal << (mirrored ? " mirrored" : "");
  }
}

TEST(BeltsAndGears, AreTheSameInOtherUnits)
{
  const test::SceneFolder folder;
  const std::string       path     = folder.write("scene.toml", both);
  const apps::SceneNode   tree     = apps::read_scene_file(path, {});
  const auto              original = run_of(tree, path);
  for (const UnitPowers &powers : other_units())
  {
    const Deviation worst = deviation_of(original, run_of(rescaled(tree, powers).scene, path), powers);
    EXPECT_LT(worst.value, 1e-8) << worst.signal << ' ' << text_of(powers);
  }
}

/// A body under a force in the plane of its bearing, at rest.
std::string in_bearing(const std::string &rows, double angle, double load)
{
  return point_body("shaft", "20 kg", "[0, 0, 0]") +
         element("bearing", "rolling bearing",
                 {{"from", "ground"},
                  {"to", "shaft"},
                  {"at", "[0, 0, 0]"},
                  {"axis", "[0, 1, 0]"},
                  {"table", rows},
                  {"axial_stiffness", "50 N/um"}}) +
         element("load", "force",
                 {{"from", "shaft"},
                  {"direction", vector(std::cos(angle), 0., std::sin(angle))},
                  {"constant", number(load)}}) +
         element("push", "force", {{"from", "shaft"}, {"direction", "[0, 1, 0]"}, {"constant", "100 N"}}) +
         start("rule = 'static'") + steps("1 us", "2 us") +
         signals("x = 'shaft.ux', y = 'shaft.uy', z = 'shaft.uz', F = 'bearing.force', e = 'bearing.eccentricity'");
}

// Its rows are met in every direction; between two of one slope it is straight, beyond the last one it goes on.
TEST(RollingBearing, YieldsByItsTableInEveryDirection)
{
  const std::string rows = "[['5 um', '1.5 kN'], ['10 um', '3.5 kN'], ['20 um', '9 kN']]";
  for (const double angle : {0., 0.7, 2.5, -1.2})
    for (const auto &[e, F] : {std::pair{5e-6, 1500.}, {1e-5, 3500.}, {2e-5, 9000.}})
    {
      const SceneRun motion = run(in_bearing(rows, angle, F));
      const auto     at     = [&](const char *name) { return motion.at(0, motion.column(name)); };
      EXPECT_NEAR(at("F"), F, 1e-9 * F);
      EXPECT_NEAR(at("e"), e, 1e-9 * e);
      EXPECT_NEAR(at("x"), e * std::cos(angle), 1e-9 * e);
      EXPECT_NEAR(at("z"), e * std::sin(angle), 1e-9 * e);
      EXPECT_NEAR(at("y"), 2e-6, 1e-9 * e);
    }
  const SceneRun straight = run(in_bearing("[['10 um', '2 kN']]", 0.4, 5000.));
  EXPECT_NEAR(straight.at(0, straight.column("e")), 2.5e-5, 1e-9 * 2.5e-5);
  expect_complaint(with(in_bearing(rows, 0., 1.), "10 um", "4 um"), "rows rise from zero");
  expect_complaint(with(in_bearing(rows, 0., 1.), "9 kN", "3 kN"), "must grow with the deflection");
}

TEST(BeltsAndGears, RefuseWhatDoesNotFit)
{
  const std::string of_belt = wheels + belt(), of_gears = wheels + gears();
  EXPECT_EQ(test::complaint(of_belt), "");
  EXPECT_EQ(test::complaint(of_gears), "");
  const std::string by_length = with(of_belt, "pretension = \"400 N\"", "length = \"1.5 m\"");
  expect_complaint(by_length, "is 1.5 m long, but its path around both wheels at a centre distance of 0.5 m is 1.675");
  expect_complaint(with(of_belt, "pretension = \"400 N\"", "pretension = \"-400 N\""), "of zero or more, got -");
  expect_complaint(with(of_belt, "pretension = \"400 N\"", ""),
                   "'pretension', the tension of both strands at rest, or 'length'");
  expect_complaint(with(of_belt, "radius_to = \"150 mm\"", "radius_to = \"450 mm\""), "m overlap");
  expect_complaint(with(of_belt, "stiffness = \"80 N/mm\"\n", ""), "'stiffness' of one strand or 'rigidity'");
  expect_complaint(with(of_belt, "to = \"two\"", "to = \"one\""), "is on 'one', the body of `from`");
  expect_complaint(with(of_belt, "axis = [0, 1, 0]\nradius", "axis = [0, 0, 1]\nradius"), "is not that of 'one'");
  expect_complaint(of_belt + "at_to = [0.5, 0.1, 0]\n", "are in two planes normal to 'axis', 0.1 m apart");
  expect_complaint(with(of_gears, "backlash = \"0.2 mm\"", "backlash = \"-0.2 mm\""), "of zero or more, got -0.2 mm");
  expect_complaint(with(of_gears, "radius_to = \"0.3 m\"", "radius_to = \"0.32 m\""),
                   "need a centre distance of 0.52 m, but their centres are 0.5 m apart");
  expect_complaint(with(of_gears, "radius_to = \"0.3 m\"", "radius_to = \"-0.1 m\""), "for a ring negative and larger");
  expect_complaint(of_gears + "pressure_angle = \"50 deg\"\n", "between 0 and 45 degrees");
  expect_complaint(of_gears + "helix_angle = \"70 deg\"\n", "between -60 and 60 degrees");
}

} // namespace
} // namespace gestell::tests
