// Joints between bodies in space: mechanisms with closed forms of their motion.

#include "tests/support/scene_motion.h"

#include <cmath>

namespace gestell::tests
{
namespace
{

std::string settings(double step, double end, const std::string &signals)
{
  return steps(number(step), number(end)) +
         table("output", {{"picture_step", "0"}, {"step", number(end / 40.)}, {"signals", signals}});
}

// --- Cardan's joint: tan phi_2 = tan phi_1 cos beta

constexpr double beta = 0.6, J_1 = 0.02, J_2 = 0.05, omega_0 = 9.;

/// Errors of the angle of the second shaft, of its speed, and of the speed of the first one, which energy tells.
struct CardanErrors
{
  double angle = 0., ratio = 0., speed = 0.;
};

CardanErrors cardan(double step)
{
  const double      c = std::cos(beta), s = std::sin(beta);
  const std::string n = vector(-s, c, 0.), end = vector(0.4 * c, 0.4 * s, 0.);
  const auto        motion = run(
             rigid_body("first", "1", "[0.02, 0.03, 0.03]", "[-0.2, 0, 0]") +
             rigid_body("second", "2", "[0.05, 0.04, 0.03]", vector(0.2 * c, 0.2 * s, 0.),
                        {{"principal_axes", "[" + vector(c, s, 0.) + ", " + n + "]"}}) +
             joint("bearing", "revolute", "ground", "first", "[-0.4, 0, 0]", {{"axis", "[1, 0, 0]"}}) +
             joint("cross", "universal", "first", "second", "[0, 0, 0]", {{"axis_from", "[0, 0, 1]"}, {"axis_to", n}}) +
             joint("up", "in-plane", "ground", "second", end, {{"axis", "[0, 0, 1]"}}) +
             joint("aside", "in-plane", "ground", "second", end, {{"axis", n}}) + start("v = { 'first.wx' = 9 }") +
             settings(step, 2., "[\"first.rx\", \"first.wx\", \"second.rx\", \"second.ry\", \"second.wx\", \"second.wy\"]"));
  CardanErrors errors;
  const auto   ratio  = [&](double phi) { return c / (1. - std::pow(std::sin(phi) * s, 2)); };
  const double energy = J_1 + J_2 * std::pow(ratio(0.), 2);
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
  {
    const double phi_1 = motion.at(i, 1), w_1 = motion.at(i, 2);
    const double phi_2 = c * motion.at(i, 3) + s * motion.at(i, 4), w_2 = c * motion.at(i, 5) + s * motion.at(i, 6);
    errors.angle =
        std::max(errors.angle, std::abs(std::sin(phi_2) * std::cos(phi_1) - std::sin(phi_1) * std::cos(phi_2) * c));
    errors.ratio = std::max(errors.ratio, std::abs(w_2 / w_1 - ratio(phi_1)));
    errors.speed =
        std::max(errors.speed, std::abs(w_1 / omega_0 - std::sqrt(energy / (J_1 + J_2 * std::pow(ratio(phi_1), 2)))));
  }
  return errors;
}

TEST(SpatialJoints, CardansJointTurnsUnevenly)
{
  const CardanErrors coarse = cardan(2e-3), fine = cardan(1e-3);
  EXPECT_LT(coarse.angle, 1e-9);
  EXPECT_NEAR(order(coarse.ratio, fine.ratio), 2., 0.15) << fine.ratio;
  EXPECT_GT(order(coarse.speed, fine.speed), 1.9) << fine.speed; // damping, of third order, has its share
  EXPECT_LT(fine.speed, 1e-4);
}

// --- a crank about z that swings a rocker about y by a coupler between a spherical and a universal joint

/// Closure error of the rocker's angle, and share of energy lost.
std::pair<double, double> crank_rocker(double step)
{
  const auto motion = run(rigid_body("crank", "1", "[0.001, 0.002, 0.002]", "[0.03, 0, 0]") +
                          rigid_body("coupler", "0.8", "[0.0005, 0.03, 0.03]", "[0.35, 0, 0.25]",
                                     {{"principal_axes", "[[1, 0, 1], [0, 1, 0]]"}}) +
                          rigid_body("rocker", "1.5", "[0.03, 0.03, 0.001]", "[0.6, 0, 0.25]") +
                          joint("O", "revolute", "ground", "crank", "[0, 0, 0]", {{"axis", "[0, 0, 1]"}}) +
                          joint("A", "spherical", "crank", "coupler", "[0.1, 0, 0]") +
                          joint("B", "universal", "coupler", "rocker", "[0.6, 0, 0.5]",
                                {{"axis_from", "[1, 0, -1]"}, {"axis_to", "[0, 1, 0]"}}) +
                          joint("B0", "revolute", "ground", "rocker", "[0.6, 0, 0]", {{"axis", "[0, 1, 0]"}}) +
                          start("v = { 'crank.wz' = 12 }") +
                          settings(step, 1.6, "[\"crank.rz\", \"rocker.ry\", \"rocker.rx\", \"B.torque\"]"));
  double     error = 0., last = -4., turns = 0.;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
  {
    const double phi = motion.at(i, 1), c = std::cos(phi), s = std::sin(phi), x = 0.6 - 0.1 * c;
    // |B - A| = 0.5 sqrt(2) with A = (0.1 c, 0.1 s, 0), B = (0.6 + 0.5 sin psi, 0, 0.5 cos psi)
    error = std::max(error, std::abs(std::sin(motion.at(i, 2)) - (0.25 - 0.01 * s * s - x * x) / x));
    error = std::max(error, std::abs(motion.at(i, 3)));
    turns += phi < last;
    last = phi;
  }
  EXPECT_GE(turns, 2); // the crank turns all the way round
  // Kinetic energy at the start: crank about O, rocker and coupler by the closure's derivative, of order 0.1 J.
  return {error, std::abs(motion.result.energy.stored)};
}

TEST(SpatialJoints, CrankRockerInSpaceClosesItsLoop)
{
  const auto coarse = crank_rocker(1e-3), fine = crank_rocker(5e-4);
  EXPECT_LT(coarse.first, 1e-9);
  EXPECT_GT(order(coarse.second, fine.second), 1.8) << fine.second;
  EXPECT_LT(fine.second, 1e-3);
}

// --- the same four-bar linkage in a plane and in space

/// A crank-rocker in the plane y = 0; in space its joints are revolute, spherical, cylindrical and revolute.
SceneRun four_bar(bool space, double step)
{
  const auto bar = [&](const std::string &name, const std::string &position)
  { return space ? rigid_body(name, "2", "[0.07, 0.06, 0.05]", position) : planar_body(name, "2", "0.06", position); };
  const Keys        axis  = space ? Keys{{"axis", "[0, 1, 0]"}} : Keys{};
  const std::string speed = space ? ".wy" : ".angle";
  return run("gravity = [0, 0, -9.81]\n" + bar("crank", "[0.05, 0, 0.1]") + bar("coupler", "[0.5, 0, 0.4]") +
             bar("rocker", "[0.95, 0, 0.3]") + joint("O", "revolute", "ground", "crank", "[0, 0, 0]", axis) +
             joint("A", space ? "spherical" : "revolute", "crank", "coupler", "[0.1, 0, 0.2]") +
             joint("B", space ? "cylindrical" : "revolute", "coupler", "rocker", "[0.9, 0, 0.6]", axis) +
             joint("C", "revolute", "rocker", "ground", "[1, 0, 0]", axis) + start("v = { 'crank" + speed + "' = 8 }") +
             settings(step, 1.,
                      "[\"crank.x\", \"coupler.x\", \"coupler.z\", \"rocker.x\", \"rocker.vz\", \"O.fx\", "
                      "\"C.fz\"]"));
}

TEST(SpatialJoints, RigidAndPlanarBodiesMakeTheSameLinkage)
{
  const auto difference = [](double step)
  {
    const auto plane = four_bar(false, step), space = four_bar(true, step);
    double     largest = 0.;
    for (std::size_t i = 0; i < plane.n_rows(); ++i)
      for (std::size_t k = 1; k < 8; ++k) // forces count in units of 100 N
        largest = std::max(largest, std::abs(space.at(i, k) - plane.at(i, k)) / (k < 6 ? 1. : 100.));
    return largest;
  };
  // Angles and directors have errors of their own, which fall alike.
  const double coarse = difference(1e-3), fine = difference(5e-4);
  EXPECT_NEAR(order(coarse, fine), 2., 0.2) << fine;
  EXPECT_LT(fine, 1e-2);
}

// The scene of the repository on pedestals that hardly yield: its loop closes as its sketch says.
TEST(SpatialJoints, TheCrankRockerOfTheScenesFollowsItsFormula)
{
  const SceneRun motion("spatial_crank_rocker.toml",
                        {"run.end=0.8 s", "output.step=20 ms", "output.picture_step=0", "parameters.c_P=1e4 kN/mm",
                         "parameters.c_V=1e4 kN/mm", "parameters.c_B=1e4 kN/mm", "parameters.b_P=1 MN s/m"});
  EXPECT_EQ(motion.result.failure, "");
  const double r = 0.1, l_R = 0.5, x_B0 = 0.6;
  for (std::size_t i = 0; i < motion.n_rows(); ++i) // crank, omega, rocker ...
  {
    const double phi = motion.at(i, 1), x = x_B0 - r * std::cos(phi), y = r * std::sin(phi);
    const double l = std::hypot(x_B0 - r, l_R);
    // Forces of some 200 N bend the pedestals by 2e-8 m.
    EXPECT_NEAR(std::sin(motion.at(i, 3)), (l * l - l_R * l_R - y * y - x * x) / (2. * l_R * x), 1e-6);
  }
  EXPECT_GT(motion.signal("crank").max, 2. * M_PI);
}

// --- partners

// A body welded to a rotor is carried round; screwed to nothing else it needs no further joint.
TEST(SpatialJoints, ARotorTurnsABodyThatIsWeldedToIt)
{
  const auto motion =
      run(rotor_body("shaft", "1", "[0, 0, 1]") + rigid_body("arm", "1", "[0.2, 0.3, 0.4]", "[0.5, 0, 0.1]") +
          joint("weld", "rigid", "shaft", "arm", "[0.2, 0, 0.1]") +
          element("motor", "force", {{"from", "shaft"}, {"about", "[0, 0, 1]"}, {"constant", "3.3 N m"}}) +
          settings(1e-3, 1., "[\"shaft.angle\", \"arm.rz\", \"arm.x\", \"arm.wz\"]"));
  const auto last = motion.n_rows() - 1;
  // 3.3 N m on 1 + 0.4 + 0.25 kg m^2, from rest: 1 rad in the first second; BDF starts with what it has.
  EXPECT_NEAR(motion.at(last, 1), 1., 5e-6);
  EXPECT_NEAR(motion.at(last, 2), motion.at(last, 1), 1e-10);
  EXPECT_NEAR(motion.at(last, 3), 0.5 * std::cos(1.), 5e-6);
  EXPECT_NEAR(motion.at(last, 4), 2., 5e-6);
}

// A slide that carries a prismatic guide: the body keeps its direction and moves with it.
TEST(SpatialJoints, APrismaticJointKeepsTheDirection)
{
  const auto motion =
      run(slider_body("slide", "1", "[1, 0, 0]") + rigid_body("tool", "1", "[0.2, 0.3, 0.4]", "[0, 0, 0.3]") +
          joint("guide", "prismatic", "slide", "tool", "[0, 0, 0.2]", {{"axis", "[0, 0, 1]"}}) +
          element("push", "force", {{"from", "tool"}, {"direction", "[1, 0, 1]"}, {"constant", "1 N"}}) +
          settings(1e-3, 1., "[\"tool.ux\", \"tool.uz\", \"tool.wy\", \"slide.displacement\"]"));
  const auto last = motion.n_rows() - 1;
  EXPECT_NEAR(motion.at(last, 1), 0.25 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(motion.at(last, 2), 0.5 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(motion.at(last, 3), 0., 1e-12);
  EXPECT_NEAR(motion.at(last, 4), motion.at(last, 1), 1e-10);
}

// Four revolute joints hold three bodies in a plane once too often for bodies in space.
TEST(SpatialJoints, OneJointTooManyIsNamedAndNotTheBody)
{
  const auto bar = rigid_body("bar", "1", "[0.2, 0.2, 0.3]", "[0.5, 0, 0]") +
                   joint("left", "revolute", "ground", "bar", "[0, 0, 0]", {{"axis", "[1, 0, 0]"}}) +
                   joint("right", "revolute", "ground", "bar", "[1, 0, 0]", {{"axis", "[1, 0, 0]"}});
  expect_refusal([&] { run(bar + settings(1e-3, 0.1, "['bar.wx']")); }, "\"right\"");
}

} // namespace
} // namespace gestell::tests
