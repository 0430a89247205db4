// The static state of machines that float: loads along motions that nothing holds are taken by inertia.

#include "coupling/equilibrium/static_equilibrium.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

/// Masses of 1, 2 and 3 kg on springs of 1 and 2 kN/m in a row along x, the last pulled by 12 N; held by a spring to
/// the ground of the stiffness given.
Machine chain(double to_ground)
{
  MachineModel     model;
  std::vector<int> x;
  for (const double m : {1., 2., 3.})
    x.push_back(model.add_slider("m" + std::to_string(x.size()), {1., 0., 0.}, m, "ground"));
  model.add_linear("first", {{x[1], 1.}, {x[0], -1.}}, {1000., 0., 0., 0.}, "N");
  model.add_linear("second", {{x[2], 1.}, {x[1], -1.}}, {2000., 0., 0., 0.}, "N");
  if (to_ground > 0.)
    model.add_linear("ground", {{x[0], 1.}}, {to_ground, 0., 0., 0.}, "N");
  model.add_load("pull", {{x[2], 1.}}, 12., {}, "N");
  return Machine(std::move(model));
}

InitialState static_state(Machine machine, Floating floating)
{
  const InitialState rest{0., Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3)};
  return static_equilibrium(machine, rest, Drift::none, floating);
}

TEST(InertiaReliefOfAMachine, BalancesLoadsByItsAcceleration)
{
  // 12 N accelerate 6 kg by 2 m/s^2: the springs carry 2 N and 6 N, the centre of mass stays where it was.
  const InitialState state = static_state(chain(0.), Floating::relieved);
  EXPECT_NEAR(state.q[1] - state.q[0], 2. / 1000., 1e-12);
  EXPECT_NEAR(state.q[2] - state.q[1], 6. / 2000., 1e-12);
  EXPECT_NEAR(state.q[0] + 2. * state.q[1] + 3. * state.q[2], 0., 1e-12);
  ASSERT_EQ(state.notes.size(), 1u);
  EXPECT_NE(state.notes[0].find("in 1 rigid-body mode;"), std::string::npos) << state.notes[0];
  EXPECT_NE(state.notes[0].find("mean acceleration of [2, 0, 0] m/s^2"), std::string::npos) << state.notes[0];
}

TEST(InertiaReliefOfAMachine, ChangesNothingWhereTheMachineIsHeld)
{
  const InitialState relieved = static_state(chain(500.), Floating::relieved);
  const InitialState held     = static_state(chain(500.), Floating::refused);
  EXPECT_LT((relieved.q - held.q).norm(), 1e-14);
  EXPECT_NEAR(held.q[0], 12. / 500., 1e-12);
  EXPECT_TRUE(relieved.notes.empty());
}

TEST(InertiaReliefOfAMachine, IsNamedAsTheWayOutWhereItWasNotAskedFor)
{
  expect_refusal([&] { static_state(chain(0.), Floating::refused); }, "inertia_relief = true");
}

} // namespace
} // namespace gestell::tests
