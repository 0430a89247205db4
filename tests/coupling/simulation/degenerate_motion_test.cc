// Runs that cannot go on say why: forces that nothing determines, motions diverged.

#include "coupling/algebra/dense_modes.h"
#include "coupling/integration/propagation/force_rule.h"
#include "coupling/simulation/simulation.h"
#include "mechanism/elements/coulomb_friction.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;

/// One mass on a spring, shaken, with dry friction of 6 N in all; the second element rubs on `weight` times its motion.
Machine rubbed(int n_elements, double weight)
{
  MachineModel model;
  const int    x = model.add_slider("mass", {1., 0., 0.}, 1., "ground");
  model.add_linear("spring", {{x, 1.}}, {100., 0., 0., 0.}, "N");
  model.add_load("shaker", {{x, 1.}}, 0., {{4., 10., M_PI / 2.}}, "N");
  for (int i = 0; i < n_elements; ++i)
    model.attach("pad" + std::to_string(i),
                 std::make_shared<mechanism::CoulombFriction>(
                     mechanism::CoulombFriction::Parameters{6. / n_elements, 6. / n_elements, 0.}),
                 {{{x, i == 0 ? 1. : weight}}});
  return Machine(std::move(model));
}

RunOptions options(const std::string &method, double step, ForceRule force = ForceRule::collocation)
{
  return run_of(tests::method(method, step, 2, {{"force", force_rule_name(force)}}), 2.);
}

using Redundant = ::testing::TestWithParam<RunOptions>;

TEST_P(Redundant, StickingOfOneMotionIsNamed)
{
  for (const double weight : {1., 0.3, -1.})
  {
    Machine           machine = rubbed(2, weight);
    const std::string failure = simulate(machine, start(0., 0.), GetParam(), {}).failure;
    EXPECT_NE(failure.find("constrain the same DOFs: mass"), std::string::npos) << weight << ": " << failure;
  }
  Machine one = rubbed(1, 1.);
  EXPECT_EQ(simulate(one, start(0., 0.), GetParam(), {}).failure, "");
}
INSTANTIATE_TEST_SUITE_P(Methods, Redundant,
                         ::testing::Values(options("bdf", 1e-3), options("newmark", 1e-3), options("exact", 1e-3),
                                           options("exact", 1e-3, ForceRule::average)),
                         [](const auto &info)
                         {
                           std::string name;
                           for (const char c : method_name(info.param.method))
                             if (std::isalnum(static_cast<unsigned char>(c)))
                               name += c;
                           return name;
                         });

TEST(Simulation, ThatGrowsBeyondAllNumbersStopsAndSaysSo)
{
  Machine    machine     = spring_and_mass(1., 100.);
  RunOptions run         = options("central-difference", 0.3); // omega h = 3
  run.end                = 500.;
  run.force_unstable     = true;
  const RunResult result = simulate(machine, start(1., 0.), run, {});
  EXPECT_NE(result.failure.find("diverged"), std::string::npos) << result.failure;
}

TEST(Simulation, AMassThatSticksCostsNoSearchForKinks)
{
  Machine    machine     = rubbed(1, 1.);
  RunOptions run         = options("exact", 1e-3, ForceRule::average);
  run.end                = 0.1; // 10 N sin(4 t) stays below 6 N
  const RunResult result = simulate(machine, start(0., 0.), run, {});
  EXPECT_LT(result.work.evaluations, 10 * result.work.steps);
}

TEST(DegenerateModes, AMotionThatFallsHasNoFrequencyAndTheOthersKeepTheirs)
{
  // Square circular frequencies -5e4, 4 and 9, in coordinates that mix all three.
  Eigen::Matrix3d V;
  V << 2., 1., 0., -1., 3., 1., 0.5, 0., 2.;
  const Eigen::MatrixXd W = V.inverse(), M = W.transpose() * W;
  const Eigen::MatrixXd C     = W.transpose() * Eigen::Vector3d(-5e4, 4., 9.).asDiagonal() * W;
  const DenseModes      modes = dense_modes(C, M);
  ASSERT_EQ(modes.omega.size(), 3);
  EXPECT_EQ(modes.omega[0], 0.);
  EXPECT_NEAR(modes.omega[1], 2., 1e-6);
  EXPECT_NEAR(modes.omega[2], 3., 1e-6);
}

} // namespace
} // namespace gestell::tests
