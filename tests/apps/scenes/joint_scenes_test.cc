// The example scenes with ideal joints against closed forms of their kinematics, and how they are drawn.

#include "apps/output/pictures/mechanism_shapes.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using Point = std::complex<double>; // in the plane of the linkage: x + i z

/// The point at distances a from p and b from q, to the left of the way from p to q.
Point meet(Point p, double a, Point q, double b)
{
  const double d = std::abs(q - p), x = (a * a - b * b + d * d) / (2. * d);
  return p + (q - p) / d * Point(x, std::sqrt(a * a - x * x));
}

} // namespace

TEST(DoubleFourBar, RockersStandWhereTheLoopsCloseAndEnergyIsKept)
{
  const SceneRun run("double_four_bar.toml");
  const Point    A0(0., 0.), B0(1., 0.), C0(2., 0.), A(0., 0.25), B(0.85, 0.6), C(1.75, 0.85);
  double         error = 0.;
  for (std::size_t i = 0; i < run.n_rows(); ++i)
  {
    const double phi = run.at(i, run.column("crank")); // clockwise, as all angles
    const Point  a   = A0 + std::polar(std::abs(A - A0), 0.5 * M_PI - phi);
    const Point  b   = meet(a, std::abs(B - A), B0, std::abs(B - B0));
    const Point  c   = meet(b, std::abs(C - B), C0, std::abs(C - C0));
    error            = std::max(error, std::abs(run.at(i, run.column("first")) + std::arg((b - B0) / (B - B0))));
    error            = std::max(error, std::abs(run.at(i, run.column("second")) + std::arg((c - C0) / (C - C0))));
  }
  EXPECT_GT(run.signal("crank").max, 6. * M_PI); // three turns and more
  EXPECT_LT(error, 1e-9);
  EXPECT_LT(run.result.energy.residual, 1e-5 * run.result.energy.input);
}

TEST(ShippedScenes, CloseAtEveryAngleOfTheirCrankAndWarnOfNothing)
{
  namespace fs = std::filesystem;
  int scenes   = 0;
  for (const auto &entry : fs::recursive_directory_iterator(shipped("")))
  {
    if (entry.path().extension() != ".toml")
      continue;
    SCOPED_TRACE(entry.path().filename());
    const auto check = [&](const std::vector<std::string> &settings)
    {
      const apps::Scene scene = apps::read_scene(entry.path().string(), settings);
      EXPECT_EQ(apps::check_scene(scene), std::vector<std::string>{});
      const bool prescribed =
          std::any_of(scene.joints.begin(), scene.joints.end(), [](const auto &joint) { return joint.law != nullptr; });
      return !prescribed && std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                        [](const auto &body)
                                        { return body.name == "crank" && body.kind == coupling::BodyKind::rotor; });
    };
    if (!check({}))
      continue;
    ++scenes;
    for (int k = 0; k < 8; ++k)
      EXPECT_NO_THROW(check({"start={rule=\"given\", q={crank=\"" + std::to_string(45 * k) + " deg\"}}"})) << k;
  }
  EXPECT_GE(scenes, 7);
}

TEST(Crane, IsDrawnWithARopeAndACylinderOfTheirLengths)
{
  const apps::Scene   scene   = apps::read_scene(shipped("crane_minimal.toml"),
                                                 {"run.end=\"0.4 s\"", "run.step=\"1 ms\"", "output.picture_step=\"0.2 s\"",
                                                  "element.strut={type=\"cubic spring\", on=\"q4\", cubic=1}"});
  coupling::Machine   machine = apps::build_machine(scene);
  const auto          run     = coupling::simulate(machine, apps::initial_state(scene, machine), scene.run.options, {});
  const apps::Scenery scenery = apps::scenery_of(machine);
  ASSERT_EQ(run.picture_states.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto  shapes = apps::mechanism_shapes(scenery, run.picture_states[k]);
    std::string names;
    for (const apps::Shape &shape : shapes)
      names += shape.name + ", ";
    ASSERT_EQ(names, "chassis, boom, load, cylinder, rope, strut, joints, ");
    const auto length = [](const apps::Shape &bar) // its last two points are the middles of the ends
    { return (bar.points[bar.points.size() - 1] - bar.points[bar.points.size() - 2]).norm(); };
    EXPECT_NEAR(length(shapes[3]), 3.08 - 0.12 * run.picture_times[k], 1e-9);
    EXPECT_NEAR(length(shapes[4]), 1.35, 1e-9);
    EXPECT_NEAR(length(shapes[5]), length(shapes[3]), 1e-12); // a spring beside the cylinder
  }
}

TEST(CrankPress, RamFollowsTheCrankAndTheStoredEnergyIsThatOfTheSliderCrank)
{
  const SceneRun run("crank_press_joints.toml");
  const double   r = 0.08, l = 0.8, s = 0.35 * l, J1 = 320., J2 = 250., m_rod = 260., J_rod = 22., m = 3100., g = 9.81;
  const auto     ram = [&](double phi)
  { return r - l - r * std::cos(phi) + std::sqrt(l * l - std::pow(r * std::sin(phi), 2)); };

  // Kinetic and potential energy with the rod at the angle asin(r/l sin phi), its centre of mass s from the crank pin.
  const auto energy = [&](double phi, double omega)
  {
    const double sine = r / l * std::sin(phi), cosine = std::sqrt(1. - sine * sine);
    const double turn = r / l * std::cos(phi) / cosine * omega; // rate of the rod's angle
    const double vx = r * std::cos(phi) * omega - s * cosine * turn, vz = -r * std::sin(phi) * omega + s * sine * turn;
    const double v = r * std::sin(phi) * omega - l * sine * turn; // of the ram, downwards
    const double z = r * std::cos(phi) - s * cosine;
    return 0.5 * (J1 * 25. + J2) * omega * omega + 0.5 * m_rod * (vx * vx + vz * vz) + 0.5 * J_rod * turn * turn +
           0.5 * m * v * v + m_rod * g * z - m * g * ram(phi);
  };

  double     error = 0.;
  const auto last = run.n_rows() - 1, phi = run.column("phi"), omega = run.column("omega");
  for (std::size_t i = 0; i <= last; ++i)
    error = std::max(error, std::abs(run.at(i, run.column("x")) - ram(run.at(i, phi))));
  EXPECT_LT(error, 1e-10);
  EXPECT_GT(run.at(last, phi), 1.5 * M_PI); // through bottom dead centre and up again

  const double stored =
      energy(run.at(last, phi), run.at(last, omega) / 5.) - energy(run.at(0, phi), run.at(0, omega) / 5.);
  EXPECT_NEAR(run.result.energy.stored, stored, 1e-5 * std::abs(stored));
  EXPECT_LT(run.result.energy.residual, 1e-3 * run.result.energy.dissipated);
}

// Held at rest by a spring, the pins on the ground carry the weights: their tilting moments and the lever of the force
// at B0 balance those of the bars about the x axis.  How they share them only stiffnesses tell.
TEST(OffsetFourBar, PinsOnTheGroundCarryTheTiltingMomentOfTheWeights)
{
  const SceneRun run(
      "offset_four_bar.toml",
      {"run.end=\"1 ms\"", "start.rule=\"static\"",
       "element.drive={type=\"spring-damper\", on=\"turn\", stiffness=\"1e6 N m/rad\"}",
       "output={signals={ A=\"A0.mx\", B=\"B0.mx\", F_A=\"A0.fz\", F_B=\"B0.fz\", mz=\"A0.mz\", y=\"tip.uy\" }}"});
  const double g = 9.81, y = 0.04, weight = (3. + 6. + 4.) * g;
  EXPECT_NEAR(run.signal("F_A").final + run.signal("F_B").final, weight, 1e-6); // 2e8 N/m times the rounding of places
  EXPECT_GT(std::abs(run.signal("A").final), 0.1);
  // Bars tilt by 1e-4: what that changes of levers and axes.
  EXPECT_NEAR(run.signal("A").final + run.signal("B").final + 2. * y * run.signal("F_B").final,
              g * (6. * y + 4. * 2. * y), 1e-3);
  EXPECT_LT(std::abs(run.signal("y").final), 1e-4);
}

} // namespace gestell::tests
