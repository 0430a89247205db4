// A frame given by matrices with rows behind the interface, from the scene to the run.

#include "apps/scene/build/build_machine.h"
#include "coupling/modes/modes.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;

constexpr double mass = 100., stiffness = 1e6, gravity = -9.81, end = 0.1;

/// Three equal masses on equal springs, one above the other; only the topmost is an interface.
const std::string chain =
    tests::mass_chain() + tests::steps("10 us", "0.1 s") + "[output.signals]\nx = \"frame.top.uz\"\n";

apps::Scene scene()
{
  return test::scene_of(chain);
}

/// omega_j = 2 sqrt(k/m) sin(theta_j / 2), shape sin(i theta_j), theta_j = (2 j - 1) pi / 7 of a chain of three.
double theta(int j)
{
  return (2 * j - 1) * M_PI / 7.;
}

double omega(int j)
{
  return 2. * std::sqrt(stiffness / mass) * std::sin(theta(j) / 2.);
}

/// The topmost mass t after gravity sets in: sum_j v_3 (v . m g) / (v . m v) (1 - cos omega_j t) / omega_j^2.
double fall_of_top(double t)
{
  double x = 0.;
  for (int j = 1; j <= 3; ++j)
  {
    const Eigen::Vector3d v(std::sin(theta(j)), std::sin(2. * theta(j)), std::sin(3. * theta(j)));
    x += v[2] * v.sum() * gravity / v.squaredNorm() * (1. - std::cos(omega(j) * t)) / std::pow(omega(j), 2);
  }
  return x;
}

double simulated_fall(coupling::Machine machine, const apps::Scene &scene)
{
  const auto start  = apps::initial_state(scene, machine);
  const auto result = coupling::simulate(machine, start, scene.run.options, apps::scene_signals(scene, machine));
  EXPECT_EQ(result.failure, "");
  return result.signals.at(0).final;
}

TEST(MatrixFrame, WithInnerRowsHasTheFrequenciesOfTheChain)
{
  const auto machine = apps::build_machine(scene());
  const auto modes   = coupling::coupled_modes(machine, Eigen::VectorXd::Zero(3), {}, 3);
  ASSERT_EQ(modes.size(), 3u);
  for (int j = 1; j <= 3; ++j) // up to rounding of an eigensolver
    EXPECT_NEAR(2. * M_PI * modes[j - 1].frequency_hz, omega(j), 1e-10 * omega(3));
  EXPECT_EQ(machine.coordinate_name(0), "frame.top.uz");
  EXPECT_EQ(machine.coordinate_name(1).rfind("frame coordinate", 0), 0u);
}

TEST(MatrixFrame, HasNoMeshToCut)
{
  std::string       text  = chain;
  const std::string frame = "[frame]\n";
  ASSERT_NE(text.find(frame), std::string::npos);
  text.insert(text.find(frame) + frame.size(), "parts = 2\n");
  tests::expect_refusal([&] { test::scene_of(text); },
                        "parts: cuts the mesh of a frame from 'cad'; a frame that is given by matrices has no mesh");
}

TEST(MatrixFrame, TakesRowsOfSectionsSupportsAndStressesByComponents)
{
  const std::string rows    = "stiffness_row = [1, 2, 3]\ninertia_row = [5, 6, 7]\nacceleration_row = [0, 0, 4]\n";
  const auto        outputs = test::scene_of(chain + "[frame.cut.low]\n" + rows + "[frame.cut.low.M1]\n" + rows +
                                             "[frame.support.foot.z]\n" + rows + "[frame.stress.root.xz]\n" + rows)
                           .frame.matrices.outputs;
  std::vector<std::string> found;
  for (const auto &output : outputs)
  {
    found.push_back(output.name + " " + output.unit);
    EXPECT_EQ(output.on_q, Eigen::Vector3d(1., 2., 3.));
    EXPECT_EQ(output.on_a, Eigen::Vector3d(5., 6., 7.));
    EXPECT_EQ(output.under_acceleration, Eigen::Vector3d(0., 0., 4.));
  }
  EXPECT_EQ(found, (std::vector<std::string>{"cut.low N", "cut.low.M1 N m", "support.foot.z N", "stress.root.xz Pa"}));
  tests::expect_refusal([&] { test::scene_of(chain + "[frame.cut.low.M3]\n" + rows); }, "M3");
}

TEST(MatrixFrame, WithInnerRowsFallsAsTheoryAndAsTheSparseFrame)
{
  const auto   chain = scene();
  const double dense = simulated_fall(apps::build_machine(chain), chain);
  // BDF2 is late by (omega h)^2 / 3 of the phase: 1e-6 of the first mode, which carries all but some per cent
  EXPECT_NEAR(dense, fall_of_top(end), 1e-5 * std::abs(fall_of_top(end)));
  const double sparse = simulated_fall(apps::build_machine(chain, chain.frame.matrices), chain);
  EXPECT_NEAR(dense, sparse, 1e-9 * std::abs(sparse)); // the same step equations, solved otherwise
}

/// The chain with a rotation of no mass on the topmost node, held to it by a spring of 4 kN m and coupled to its lift.
apps::Scene chain_with_massless_rotation(const std::string &damping = "")
{
  std::string text = chain;
  const auto  put  = [&text](const std::string &piece, const std::string &replacement)
  { text.replace(text.find(piece), piece.size(), replacement); };
  put("[0, 0, 100]]", "[0, 0, 100, 0], [0, 0, 0, 0]]");
  put("[[100, 0, 0], [0, 100, 0]", "[[100, 0, 0, 0], [0, 100, 0, 0]");
  // [k + a^2 c, a c; a c, c]: the spring c turns by a u + phi, so that phi = -a u carries no force
  put("[[2e6, -1e6, 0], [-1e6, 2e6, -1e6], [0, -1e6, 1e6]]",
      "[[2e6, -1e6, 0, 0], [-1e6, 2e6, -1e6, 0], [0, -1e6, 1.16e6, 8e4], [0, 0, 8e4, 4e4]]" + damping);
  put("[0, 0, 1]]", "[0, 0, 1], [0, 0, 0]]");
  put("rows = { uz = 3 }", "rows = { uz = 3, ry = 4 }");
  return test::scene_of(text);
}

TEST(MatrixFrame, WithARotationOfNoMassMovesAsWithoutIt)
{
  const auto chain = chain_with_massless_rotation();
  const auto modes = coupling::coupled_modes(apps::build_machine(chain), Eigen::VectorXd::Zero(4), {}, 4);
  ASSERT_EQ(modes.size(), 3u); // the rank of M
  for (int j = 1; j <= 3; ++j)
    EXPECT_NEAR(2. * M_PI * modes[j - 1].frequency_hz, omega(j), 1e-10 * omega(3));
  const double dense = simulated_fall(apps::build_machine(chain), chain), exact = fall_of_top(end);
  EXPECT_NEAR(dense, exact, 1e-5 * std::abs(exact)); // as above
  const double sparse = simulated_fall(apps::build_machine(chain, chain.frame.matrices), chain);
  EXPECT_NEAR(dense, sparse, 1e-9 * std::abs(sparse));
}

TEST(MatrixFrame, WithARotationOfNoMassHasItsModalDamping)
{
  const auto chain = chain_with_massless_rotation("\ndamping = { ratio = 0.03, modes = [{ mode = 2, ratio = 0.01 }] }");
  const auto modes = coupling::coupled_modes(apps::build_machine(chain), Eigen::VectorXd::Zero(4), {}, 3);
  for (std::size_t j = 0; j < modes.size(); ++j)
    EXPECT_NEAR(modes[j].damping_ratio, j == 1 ? 0.01 : 0.03, 1e-9);
}

} // namespace
