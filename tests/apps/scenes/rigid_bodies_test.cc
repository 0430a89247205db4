// Bodies that turn freely in space: tops against Euler's equations, and what else acts on them.

#include "coupling/modes/modes.h"
#include "tests/support/scene_motion.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gestell::tests
{
namespace
{

using Eigen::Matrix3d, Eigen::Vector3d;

std::string text(const Vector3d &x)
{
  return vector(x[0], x[1], x[2]);
}

/// The entries of a vector of start values: 'body.wx' = 1, ...
std::string entries(const std::string &body, const std::string &letter, const Vector3d &x)
{
  std::string list;
  for (int d = 0; d < 3; ++d)
    list += (d ? ", '" : "'") + body + '.' + letter + "xyz"[d] + "' = " + number(x[d]);
  return list;
}

std::string top(double mass, const Vector3d &inertia, const Vector3d &position)
{
  return rigid_body("top", number(mass), text(inertia), text(position));
}

std::string settings(double step, double end)
{
  return steps(number(step), number(end)) +
         table("output", {{"picture_step", "0"},
                          {"step", number(end / 10.)},
                          {"signals", "['top.x', 'top.y', 'top.z', 'top.vx', 'top.vy', 'top.vz', 'top.rx', 'top.ry', "
                                      "'top.rz', 'top.wx', 'top.wy', 'top.wz']"}});
}

/// Position, velocity, rotation or angular velocity in a row of a run with those settings.
enum Kind
{
  position = 0,
  velocity = 3,
  rotation = 6,
  spin     = 9
};
Vector3d triple(const SceneRun &run, std::size_t row, Kind kind)
{
  return {run.at(row, 1 + kind), run.at(row, 2 + kind), run.at(row, 3 + kind)};
}

Matrix3d matrix(const Vector3d &rotation)
{
  return rotation.norm() > 0. ? Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix()
                              : Matrix3d(Matrix3d::Identity());
}

/// A rotation R and the angular velocity in axes of the body, by Euler's equations J w' = -w x J w, R' = R [w x].
struct EulerTop
{
  Vector3d J, w;
  Matrix3d R = Matrix3d::Identity();

  void follow(double time, int steps) // Runge and Kutta's classical method
  {
    const double h = time / steps;
    for (int k = 0; k < steps; ++k)
    {
      const auto rates = [this](const Matrix3d &R_now, const Vector3d &w_now, Matrix3d &dR, Vector3d &dw)
      {
        for (int i = 0; i < 3; ++i)
          dR.row(i) = R_now.row(i).transpose().cross(w_now).transpose();
        dw = -w_now.cross(J.cwiseProduct(w_now)).cwiseQuotient(J);
      };
      Matrix3d dR[4];
      Vector3d dw[4];
      rates(R, w, dR[0], dw[0]);
      rates(R + 0.5 * h * dR[0], w + 0.5 * h * dw[0], dR[1], dw[1]);
      rates(R + 0.5 * h * dR[1], w + 0.5 * h * dw[1], dR[2], dw[2]);
      rates(R + h * dR[2], w + h * dw[2], dR[3], dw[3]);
      R += h / 6. * (dR[0] + 2. * dR[1] + 2. * dR[2] + dR[3]);
      w += h / 6. * (dw[0] + 2. * dw[1] + 2. * dw[2] + dw[3]);
    }
  }
};

struct TopErrors
{
  double rotation = 0., spin = 0., momentum = 0., energy = 0.;
};

TopErrors tumbling(double step)
{
  const Vector3d J(1., 2., 2.5), w(0.5, 4., 0.3); // about the middle axis: it tumbles over
  const auto     motion = run(top(3., J, {1., 0., 0.}) + start("v = { 'top.uy' = 2, " + entries("top", "w", w) + " }") +
                              settings(step, 4.));
  const Vector3d L      = J.cwiseProduct(w);
  EulerTop       exact{J, w};
  TopErrors      errors;
  for (std::size_t i = 1; i < motion.n_rows(); ++i)
  {
    exact.follow(0.4, 4000); // its own error is below 1e-11
    const Matrix3d R     = matrix(triple(motion, i, rotation));
    const Vector3d omega = triple(motion, i, spin), body = R.transpose() * omega;
    errors.rotation = std::max(errors.rotation, (R - exact.R).norm());
    errors.spin     = std::max(errors.spin, (omega - exact.R * exact.w).norm());
    errors.momentum = std::max(errors.momentum, (R * J.cwiseProduct(body) - L).norm() / L.norm());
    errors.energy   = std::max(errors.energy, std::abs(body.dot(J.cwiseProduct(body)) / w.dot(L) - 1.));
    EXPECT_NEAR(motion.at(i, 2), 2. * motion.at(i, 0), 1e-9); // the centre of mass flies on
  }
  return errors;
}

TEST(RigidBody, UnsymmetricTopTumblesAsEulersEquationsSay)
{
  const TopErrors coarse = tumbling(2e-3), fine = tumbling(1e-3);
  EXPECT_NEAR(order(coarse.rotation, fine.rotation), 2., 0.1) << fine.rotation;
  EXPECT_NEAR(order(coarse.spin, fine.spin), 2., 0.1) << fine.spin;
  EXPECT_LT(fine.spin, 2e-3);
  // Kept to the error of the method; its damping, of third order, has its share.
  EXPECT_GT(order(coarse.momentum, fine.momentum), 1.8) << fine.momentum;
  EXPECT_GT(order(coarse.energy, fine.energy), 1.8) << fine.energy;
  EXPECT_LT(fine.momentum, 1e-4);
  EXPECT_LT(fine.energy, 1e-5);
}

/// Largest deviation of the axis of figure from its cone about the angular momentum.
double cone_error(double step)
{
  const double   J_1 = 1., J_3 = 1.6;
  const Vector3d w(1.5, 0., 5.), L(J_1 * w[0], 0., J_3 * w[2]);
  // Described about axes of its own, which the tensor tells.
  const auto motion =
      run(rigid_body("top", "1", "[1.6, 1, 1]", "[0, 0, 0]", {{"principal_axes", "[[0, 0, 2], [1, 1, 0]]"}}) +
          start("v = { " + entries("top", "w", w) + " }") + settings(step, 2.));
  double error = 0.;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
  {
    const Vector3d figure = Eigen::AngleAxisd(L.norm() / J_1 * motion.at(i, 0), L.normalized()) * Vector3d(0., 0., 1.);
    error                 = std::max(error, (matrix(triple(motion, i, rotation)).col(2) - figure).norm());
  }
  return error;
}

TEST(RigidBody, SymmetricTopPrecessesRegularly)
{
  const double coarse = cone_error(1e-3), fine = cone_error(5e-4);
  EXPECT_NEAR(order(coarse, fine), 2., 0.1) << fine;
  EXPECT_LT(fine, 1e-3);
}

/// A symmetric top on its tip, 100 mm below the centre of mass, leaning by 30 degrees.
struct HeavyTop
{
  double m = 1., l = 0.1, J_1 = 0.011, J_3 = 0.02, g = 9.81, lean = M_PI / 6., Omega = 5.;

  Vector3d figure() const { return {0., -std::sin(lean), std::cos(lean)}; }
  /// Angular velocity of the steady precession Omega:  (J_3 w_3 - (J_1 + m l^2) Omega cos) Omega = m g l.
  Vector3d steady() const
  {
    const double c = std::cos(lean), w_3 = (m * g * l / Omega + (J_1 + m * l * l) * Omega * c) / J_3;
    return Omega * (Vector3d::UnitZ() - c * figure()) + w_3 * figure();
  }
  std::string scene(const std::string &body, const Vector3d &w) const
  {
    return "gravity = [0, 0, -9.81]\n" + body + joint("tip", "spherical", "ground", "top", "[0, 0, 0]") +
           start("q = { 'top.rx' = '30 deg' }\nv = { " + entries("top", "w", w) + " }");
  }
};

double precession_error(double step, Kind kind)
{
  const HeavyTop top_on_tip;
  const auto     motion =
      run(top_on_tip.scene(top(1., {0.011, 0.011, 0.02}, {0., 0., 0.1}), top_on_tip.steady()) + settings(step, 1.));
  double error = 0.;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
  {
    const Eigen::AngleAxisd turned(top_on_tip.Omega * motion.at(i, 0), Vector3d::UnitZ());
    const Vector3d          at       = turned * (top_on_tip.l * top_on_tip.figure());
    const Vector3d          expected = kind == position ? at : Vector3d(top_on_tip.Omega * Vector3d::UnitZ().cross(at));
    error                            = std::max(error, (triple(motion, i, kind) - expected).norm() / expected.norm());
  }
  return error;
}

TEST(RigidBody, HeavyTopPrecessesSteadily)
{
  for (const Kind kind : {position, velocity})
  {
    const double coarse = precession_error(5e-4, kind), fine = precession_error(2.5e-4, kind);
    EXPECT_NEAR(order(coarse, fine), 2., 0.15) << fine;
    EXPECT_LT(fine, 1e-3);
  }
}

// m = 1 at 0.1 m of which half is a point mass at 0.14 m: the rest lies at 0.06 m.
TEST(RigidBody, APointMassTurnsWithItsBody)
{
  const HeavyTop    whole;
  const double      moved = 2. * 0.5 * 0.04 * 0.04;
  const std::string parts =
      top(0.5, {0.014 - moved, 0.014 - moved, 0.016}, {0., 0., 0.06}) +
      element("lump", "point mass",
              {{"on", "top"}, {"mass", "0.5"}, {"offset", "[0, 0, 0.08]"}, {"inertia", "[0.002, 0.002, 0.004]"}});
  const Vector3d w(0.3, -0.2, 12.); // nutates
  const auto     one = run(whole.scene(top(1., {0.016, 0.016, 0.02}, {0., 0., 0.1}), w) + settings(1e-3, 1.));
  const auto     two = run(whole.scene(parts, w) + settings(1e-3, 1.));
  for (std::size_t i = 0; i < one.n_rows(); ++i)
    EXPECT_LT((triple(one, i, spin) - triple(two, i, spin)).norm(), 1e-8);
  EXPECT_GT((triple(one, 10, rotation) - triple(one, 0, rotation)).norm(), 0.5);
}

// On a rod through its centre of mass a body swings as a point does, whatever its inertia.
TEST(RigidBody, SwingsAsASphericalPendulum)
{
  const std::string gravity = "gravity = [0, 0, -9.81]\n", at = "[0.6, 0, -0.8]",
                    rest =
                        joint("rod", "distance", {{"from", "ground"}, {"to", "top"}}) + start("v = { 'top.uy' = 2 }") +
                        steps("1 ms", "2 s") +
                        table("output", {{"picture_step", "0"},
                                         {"step", "0.1 s"},
                                         {"signals", "['top.x', 'top.y', 'top.z', 'top.vx', 'top.vy', 'rod.force']"}});
  const auto point = run(gravity + point_body("top", "2", at) + rest);
  const auto body  = run(gravity + rigid_body("top", "2", "[0.3, 0.4, 0.5]", at) + rest);
  for (std::size_t i = 0; i < point.n_rows(); ++i)
  {
    for (std::size_t k = 1; k < 7; ++k)
      EXPECT_NEAR(body.at(i, k), point.at(i, k), 1e-8);
    // Its angular momentum about the vertical stays: 0.6 m times 2 m/s, but for the error of the method.
    EXPECT_NEAR(body.at(i, 1) * body.at(i, 5) - body.at(i, 2) * body.at(i, 4), 1.2, 1e-4);
  }
}

/// A body on a hinge along z through its centre of mass, whose angle is measured.
const std::string hinged = rigid_body("top", "1", "[0.4, 0.3, 0.5]", "[0.1, 0, 0]") +
                           revolute("hinge", "ground", "top", "[0.1, 0, 0]", {{"axis", "[0, 0, 1]"}}) +
                           measure("twist", "angle", {{"from", "top"}, {"to", "ground"}, {"about", "[0, 0, 1]"}});

// Large angles of twist about a joint's axis: a spring on them is linear.
double torsion_error(double step)
{
  const double c = 8., J_z = 0.5;
  const auto   motion =
      run(hinged + element("spring", "cubic spring", {{"on", "twist"}, {"stiffness", "8"}, {"cubic", "0"}}) +
          start("q = { 'top.rz' = '120 deg' }") + settings(step, 2.));
  double error = 0.;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
    error = std::max(error, std::abs(triple(motion, i, rotation)[2] -
                                     2. / 3. * M_PI * std::cos(std::sqrt(c / J_z) * motion.at(i, 0))));
  return error;
}

// The measure tells no turns, the law that drives it goes on: 9 rad are 9 - 2 pi on it.
TEST(RigidBody, IsDrivenThroughManyTurnsByAnAngleWithoutTurns)
{
  const auto motion =
      run(hinged + joint("drive", "prescribed motion", {{"on", "twist"}, {"motion", "{ speed = '3 rad/s' }"}}) +
          start("v = { 'top.wz' = 3 }") + settings(1e-3, 3.));
  const std::size_t last = motion.n_rows() - 1;
  EXPECT_NEAR(triple(motion, last, rotation)[2], 9. - 2. * M_PI, 1e-9);
}

TEST(RigidBody, ATorsionSpringActsOnTheAngleBetweenBodies)
{
  const double coarse = torsion_error(2e-3), fine = torsion_error(1e-3);
  EXPECT_NEAR(order(coarse, fine), 2., 0.1) << fine;
  EXPECT_LT(fine, 1e-3);
}

const std::string hanging = "gravity = [0, 0, -9.81]\n" + rigid_body("top", "2", "[0.02, 0.03, 0.04]", "[0, 0, -0.3]");

// Frequencies of the physical pendulum about either axis; nothing holds its spin.
TEST(RigidBody, HangsWithTheFrequenciesOfAPhysicalPendulum)
{
  const apps::Scene scene   = test::scene_of(hanging + joint("hook", "spherical", "ground", "top", "[0, 0, 0]"));
  coupling::Machine machine = apps::build_machine(scene);
  const auto        modes   = coupling::coupled_modes(machine, apps::modes_configuration(scene, machine), {}, 6);
  const auto        hertz   = [](double J) { return std::sqrt(2. * 9.81 * 0.3 / (J + 2. * 0.09)) / (2. * M_PI); };
  ASSERT_EQ(modes.size(), 3u);
  EXPECT_NEAR(modes[0].frequency_hz, 0., 1e-6);
  EXPECT_NEAR(modes[1].frequency_hz, hertz(0.03), 1e-9);
  EXPECT_NEAR(modes[2].frequency_hz, hertz(0.02), 1e-9);
}

// On a cross the spin is held: the centre of mass comes to rest below it.
TEST(RigidBody, ComesToRestBelowItsJoint)
{
  const auto   motion = run(hanging +
                            joint("hook", "universal", "ground", "top", "[0.1, 0.05, 0]",
                                  {{"axis_from", "[1, 0, 0]"}, {"axis_to", "[0, 1, 0]"}}) +
                            start("rule = 'static'") + settings(1e-3, 0.1));
  const double length = std::sqrt(0.1 * 0.1 + 0.05 * 0.05 + 0.3 * 0.3);
  for (const std::size_t row : {std::size_t(0), motion.n_rows() - 1})
    EXPECT_LT((triple(motion, row, position) - Vector3d(0.1, 0.05, -length)).norm(), 1e-9);
}

// 0.1 rad a step: BDF 2 damps the directors by about (w h)^4/4 a step, so that the spin dies away; and says what helps.
TEST(RigidBody, ALossOfSpinGivesAWarningWithItsRemedy)
{
  const std::string top = rigid_body("top", "1", "[0.2, 0.3, 0.4]", "[0, 0, 0]") +
                          start("v = { 'top.wz' = '100 rad/s' }") + steps("1 ms", "0.5 s") + signals("w = 'top.wz'");
  const auto second = run(top), fourth = run(top, {"run.order=4"});
  ASSERT_FALSE(second.result.findings.empty());
  EXPECT_NE(second.result.findings.back().text.find("order = 4 with at least 60 steps per period"), std::string::npos)
      << second.result.findings.back().text;
  EXPECT_LT(std::abs(100. - fourth.signal("w").final), 0.1 * (100. - second.signal("w").final));
}

TEST(RigidBody, BadInputIsRefusedWithItsReason)
{
  const auto body = [](const std::string &inertia)
  { return "[body.top]\ntype = \"rigid\"\nmass = 1\nposition = [0, 0, 0]\n" + inertia; };
  const std::string good = body("inertia = [1, 1, 1]\n");
  expect_complaint("[body.top]\ntype = \"rigid\"\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n", "mass");
  expect_complaint(body(""), "inertia");
  expect_complaint(body("inertia = 3\n"), "three moments");
  expect_complaint(body("inertia = [1, 2, 4]\n"), "none may exceed the sum of the other two");
  expect_complaint(body("inertia = [1, 1, 2]\n"), "no thickness");
  expect_complaint(body("inertia = [0, 1, 1]\n"), "own axis");
  expect_complaint(body("inertia = [[2, 0.1, 0], [0.2, 2, 0], [0, 0, 2]]\n"), "symmetric");
  expect_complaint(body("inertia = [[2, 0], [0, 2]]\n"), "three rows");
  expect_complaint(body("inertia = [1, 2, 2]\nprincipal_axes = [[1, 0, 0], [1, 1, 0]]\n"), "needs two perpendicular directions");
  expect_complaint(good + rotor_body("wheel", "1", "[0, 0, 1]", {{"on", "top"}}), "is a free spatial body");
  expect_complaint(good + "[element.spring]\ntype = \"spring-damper\"\nfrom = \"top\"\nabout = [0, 0, 1]\n"
                          "stiffness = \"1 N m/rad\"\n",
                   "use a [measure]");
  const std::string joint = good + "[joint.pin]\nfrom = \"ground\"\nto = \"top\"\nat = [0, 0, 0]\n";
  expect_complaint(joint + "type = \"revolute\"\n", "axis");
  expect_complaint(joint + "type = \"universal\"\naxis_from = [0, 0, 1]\naxis_to = [0, 1, 1]\n", "must be perpendicular");
  expect_complaint(joint + "type = \"gear\"\nratio = 2\n", "gear");
  expect_complaint(good + "[body.bob]\ntype = \"point\"\nmass = 1\nposition = [1, 0, 0]\n[joint.pin]\n"
                          "type = \"revolute\"\nfrom = \"bob\"\nto = \"top\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n",
                   "spherical");
  expect_complaint(good + "[start]\nv = { \"top.rx\" = 1 }\n", "no coordinate");
}

// The other way to be out of balance: a planar body whose centre of mass lies beside its joint is a rotor of the
// unbalance m e and of the inertia J + m e^2; both runs err by the square of their step.
TEST(PlanarBody, BesideItsJointIsARotorOutOfBalance)
{
  const std::string block =
      slider_body("block", "10", "[1, 0, 0]") +
      element("spring", "spring-damper", {{"from", "block"}, {"stiffness", "40 N/mm"}, {"damping", "50 N s/m"}}) +
      steps("20 us", "0.5 s");
  const auto on = [](const std::string &text, const std::string &speed)
  { return text + signals("x = 'block.displacement', w = '" + speed + "'"); };
  const SceneRun rotor = run(on(
                     block +
                         rotor_body("wheel", "0.0202", "[0, 1, 0]",
                                    {{"on", "block"}, {"mass", "2"}, {"unbalance", "20 g m"}}) +
                         element("motor", "force",
                                 {{"from", "wheel"}, {"to", "ground"}, {"about", "[0, 1, 0]"}, {"constant", "4 N m"}}),
                     "wheel.speed")),
                 body  = run(on(
                      block + planar_body("wheel", "2", "0.02", "['10 mm', 0, 0]") +
                          revolute("pin", "block", "wheel", "[0, 0, 0]") +
                          element("motor", "force",
                                  {{"from", "wheel"}, {"to", "ground"}, {"about", "[0, 1, 0]"}, {"constant", "4 N m"}}),
                      "wheel.speed"));
  EXPECT_GT(rotor.signal("x").max, 1e-3);
  for (const char *name : {"x", "w"})
  {
    const double size = rotor.signal(name).max - rotor.signal(name).min;
    EXPECT_NEAR(body.signal(name).max, rotor.signal(name).max, 1e-4 * size) << name;
    EXPECT_NEAR(body.signal(name).min, rotor.signal(name).min, 1e-4 * size) << name;
    EXPECT_NEAR(body.signal(name).final, rotor.signal(name).final, 1e-3 * size) << name;
  }
}

} // namespace
} // namespace gestell::tests
