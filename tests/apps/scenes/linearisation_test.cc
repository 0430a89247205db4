// What is linear about a motion: the matrices that frequency responses, poles and stability are made of are the
// derivatives of the forces as a run has them, for every kind of element and every shipped scene.

#include "apps/scene/elements/element_types.h"
#include "coupling/modes/modes.h"
#include "coupling/periodic/response/linear_response.h"
#include "coupling/periodic/response/linearised_system.h"
#include "coupling/sensitivity/frequency_sensitivities.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using coupling::LocalState;
using coupling::Machine;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Forces p [n_u] of elements and joints with the histories of `at`, at another motion.
Vector forces(const Machine &machine, const LocalState &at)
{
  Vector p = Vector::Zero(at.u.size());
  machine.forces().force(at, p);
  const int n_c = machine.joints().n_rows();
  if (n_c == 0)
    return p;
  coupling::ConstraintJacobian G(machine.joints().blocks());
  Vector                       g(n_c), of_joints = p;
  machine.joints().constraints(at, g, G);
  G.set_forces(at.lambda, of_joints);
  for (const coupling::ConstraintBlock &block : machine.joints().blocks())
    p.segment(block.first_measure, block.n_measures) = of_joints.segment(block.first_measure, block.n_measures);
  return p;
}

/// -dp/dx by central differences of two steps, extrapolated: their error is of fourth order.
Matrix differences(const Machine &machine, const LocalState &at, Vector LocalState::*x, double step)
{
  const auto n = (at.*x).size();
  Matrix     D(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
  {
    const double h        = step * std::max(1., std::abs((at.*x)[j]));
    const auto   quotient = [&](double way)
    {
      LocalState nearby = at;
      (nearby.*x)[j] += way;
      const Vector above = forces(machine, nearby);
      (nearby.*x)[j] -= 2. * way;
      return Vector((forces(machine, nearby) - above) / (2. * way));
    };
    D.col(j) = (4. * quotient(0.5 * h) - quotient(h)) / 3.;
  }
  return D;
}

/// Largest difference of a block beside its largest entry, but for rounding of forces and of displacements of a metre,
/// over the step.
double distance(const Matrix &found, const Matrix &expected, double force, double stiffness, double step)
{
  const double rounding = 8. * std::numeric_limits<double>::epsilon() * (force + stiffness) / step;
  const double off      = (found - expected).cwiseAbs().maxCoeff();
  return off <= rounding ? 0. : off / std::max(expected.cwiseAbs().maxCoeff(), 1e-300);
}

Matrix stiffness_of_joints(const Machine &machine, const LocalState &local)
{
  Matrix all, K;
  machine.geometric(local, all);
  K.setZero(all.rows(), all.cols());
  for (const coupling::ConstraintBlock &block : machine.joints().blocks())
    K.block(block.first_measure, block.first_measure, block.n_measures, block.n_measures) =
        all.block(block.first_measure, block.first_measure, block.n_measures, block.n_measures);
  return K;
}

/// Beside the start, in no special position, all branches as they are there; at rest, where directions turn by the
/// displacement alone, or in motion, where rates turn with them.
void expect_exact(const apps::Scene &scene, const std::string &name, bool moves)
{
  Machine machine = apps::build_machine(scene);
  if (machine.forces().need_multipliers()) // friction in joints: frequency responses refuse it
    return;
  const coupling::InitialState start = apps::initial_state(scene, machine);
  std::mt19937                 numbers(7);
  const auto                   random = [&](double size, Eigen::Index n)
  {
    std::uniform_real_distribution<double> any(-size, size);
    Vector                                 x(n);
    for (double &value : x)
      value = any(numbers);
    return x;
  };
  LocalState local;
  local.resize(machine);
  machine.gather(start.t, start.q, start.v, Vector::Zero(machine.size()), local);
  const auto n_u = local.u.size();
  local.u += random(1e-3, n_u).cwiseProduct(local.u.cwiseAbs().cwiseMax(1.));
  if (moves)
    local.v += random(0.1, n_u);
  else
    local.v.setZero();
  local.a += random(1., n_u);
  local.lambda = random(1e3, local.lambda.size());
  machine.events().follow_history(true);
  machine.events().start(local);
  if (n_u == 0)
    return;
  const coupling::LinearResponse    response(machine, {local, stiffness_of_joints(machine, local)});
  const coupling::LinearisedSystem &own      = response.parts();
  const Vector                      p        = forces(machine, local);
  constexpr double                  shares[] = {1., 0.1, 0.01};
  struct Part
  {
    const char   *what;
    const Matrix &found;
    Vector LocalState::*x;
    double              step;
  };
  for (const Part &part : {Part{"u", own.K_u, &LocalState::u, 2e-5}, Part{"u'", own.B_u, &LocalState::v, 1e-3},
                           Part{"u''", own.M_u, &LocalState::a, 1e-2}})
  {
    // Laws bend over a millimetre or a micrometre: the step that errs least counts.
    std::vector<Matrix> expected;
    for (const double share : shares)
      expected.push_back(differences(machine, local, part.x, share * part.step));
    int first = 0;
    for (const coupling::ElementPlacement &placement : machine.model().elements())
    {
      const int k = placement.element->n_measures();
      if (k == 0)
        continue;
      const auto   block = [&](const Matrix &of) { return Matrix(of.block(first, first, k, k)); };
      const double force = p.segment(first, k).cwiseAbs().maxCoeff(), stiffness = block(own.K_u).cwiseAbs().maxCoeff();
      double       least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < expected.size(); ++i)
        least =
            std::min(least, distance(block(part.found), block(expected[i]), force, stiffness, shares[i] * part.step));
      EXPECT_LE(least, 1e-6) << name << ": force of \"" << placement.name << "\" by " << part.what << "\nfound\n"
                             << block(part.found) << "\nexpected\n"
                             << block(expected[0]);
      first += k;
    }
  }
}

using LinearisedScene = ::testing::TestWithParam<const char *>;

TEST_P(LinearisedScene, HasTheDerivativesOfItsForces)
{
  for (const bool moves : {false, true})
    expect_exact(apps::read_scene(shipped(GetParam())), GetParam(), moves);
}

INSTANTIATE_TEST_SUITE_P(Shipped, LinearisedScene,
                         ::testing::Values("cam_follower.toml", "crane_minimal.toml", "crane_minimal_elastic.toml",
                                           "crane_minimal_lift.toml", "crank_press_joints.toml", "double_four_bar.toml",
                                           "geneva_drive.toml", "offset_four_bar.toml", "press_emergency_stop.toml",
                                           "press_minimal.toml", "press_minimal_light.toml", "press_strokes.toml",
                                           "run_up.toml", "slider_crank_journal.toml", "spatial_crank_rocker.toml"));

/// What the examples of elements act on; as in the tests of the reference.
const std::string bodies =
    "gravity = [0, 0, '-9.81 m/s^2']\n" + rotor_body("crank", "250", "[0, 1, 0]", {{"position", "[0.6, 0, 0]"}}) +
    rotor_body("flywheel", "100", "[0, 1, 0]") + slider_body("slide", "3 t", "[0, 0, -1]") +
    point_body("spindle", "20", "[0, 0, 0]") + rigid_body("lance", "20", "[1, 1, 1]", "[0, 0, 0]") +
    steps("1 ms", "1 s") + signals("a = 'crank.angle'");

TEST(LinearisedElement, OfEachTypeHasTheDerivativesOfItsForce)
{
  for (const apps::ElementType &type : apps::element_types())
    for (const std::string &example : type.examples)
      expect_exact(test::scene_of(bodies + "[element.e]\ntype = \"" + type.name + "\"\n" + example), type.name, true);
}

/// A plate that turns, and another one, both with arms: elements between them act along directions that turn.
const std::string plates = planar_body("a", "2", "0.3", "[0.1, 0, 0.2]") +
                           planar_body("b", "3", "0.5", "[0.9, 0, -0.3]") + place("p", "a", "[0.4, 0, 0.3]") +
                           place("r", "b", "[0.6, 0, -0.1]") + steps("1 ms", "1 s") + signals("x = 'a.x'") +
                           start("v = { 'a.angle' = 2, 'b.angle' = -3 }");

TEST(LinearisedElement, ThatTurnsWithTheMotionHasTheDerivativesOfItsForce)
{
  const Keys        between   = {{"from", "p"}, {"to", "r"}};
  const std::string distance  = measure("d", "distance", between);
  const auto        on_length = [&](const std::string &type, Keys keys)
  {
    keys.insert(keys.begin(), {"on", "d"});
    return distance + element("e", type, keys);
  };
  const std::string scenes[] = {
      on_length("spring-damper", {{"stiffness", "2e3"}, {"damping", "40"}, {"preload", "300"}}),
      on_length("cubic spring", {{"stiffness", "2e3"}, {"cubic", "1e4"}}),
      on_length("formula force", {{"force", "300 N - 40 N*s/m*v + 2e3 N/m*u"}}),
      on_length("friction", {{"force", "100"}, {"speed", "3 m/s"}}),
      element("e", "force", {{"from", "p"}, {"direction", "[0, 0, 1]"}, {"carried_by", "a"}, {"constant", "300"}}),
      joint("e", "revolute", "a", "b", "[0.5, 0, 0.1]", {{"stiffness", "1e5"}, {"damping", "300"}})};
  for (const std::string &scene : scenes)
    for (const bool moves : {false, true})
      expect_exact(test::scene_of(plates + scene), scene, moves);
}

/// A machine with the modes it has before any run.
struct AtRest
{
  explicit AtRest(const apps::Scene &scene)
      : machine(apps::build_machine(scene)), q(apps::modes_configuration(scene, machine)),
        modes(coupling::linearised_modes(machine, q, {}, 20))
  {
  }

  Machine                     machine;
  Vector                      q;
  std::vector<coupling::Mode> modes;
};

// Two weights that balance: v^T K v is the difference of the two.
TEST(LinearisedMachine, HasNoFrequencyWhereItsWeightsBalance)
{
  for (const double height : {0.37, 0.1234567, 0.7})
  {
    const std::string seesaw =
        "gravity = [0, 0, -9.81]\n" + planar_body("b", "3.3", "1.1", "[0, 0, 0]") +
        revolute("j", "ground", "b", "[0, 0, 0]") + point_body("c", "3.7", vector(0.1, 0., height)) +
        point_body("d", "3.7", vector(-0.1, 0., -height)) + revolute("k", "b", "c", vector(0.1, 0., height)) +
        revolute("l", "b", "d", vector(-0.1, 0., -height)) + steps("1 ms", "1 s") + signals("a = 'b.angle'");
    const AtRest at(test::scene_of(seesaw));
    ASSERT_EQ(at.modes.size(), 1u);
    EXPECT_EQ(at.modes[0].frequency_hz, 0.);
    EXPECT_EQ(at.modes[0].growth, 0.);
    EXPECT_NE(coupling::without_derivative(at.modes, 0), "");
  }
}

} // namespace
} // namespace gestell::tests
