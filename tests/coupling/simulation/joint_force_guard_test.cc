// Forces of joints that nothing in the machine could cause end a run; those of a stretched linkage do not.

#include "coupling/simulation/simulation.h"
#include "coupling/simulation/stepped_run.h"
#include "tests/support/jointed_machines.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using coupling::InitialState;
using coupling::RunResult;

RunResult run(MachineModel model, double step, double end)
{
  Machine      machine(std::move(model));
  InitialState initial;
  initial.q = initial.v = Eigen::VectorXd::Zero(machine.size());
  return coupling::simulate(machine, initial, run_of(bdf(2, step), end), {});
}

/// A body on rails along y that falls; of its height an equation knows a share.
MachineModel guided(double share)
{
  MachineModel machine;
  machine.set_gravity({0., -9.81, 0.});
  add_planar(machine, "body", 2., 0.1, {});
  add_joint(machine, "rail", "ground", "body", {}, {along("fx", Vector3d::UnitX())});
  if (share > 0.)
    add_joint(machine, "plane", "ground", "body", {}, {along("fz", Vector3d(0., share, 1.))});
  return machine;
}

TEST(JointForceGuard, EndsARunInWhichAnEquationOfRoundingHoldsABody)
{
  EXPECT_EQ(run(guided(0.), 1e-3, 0.1).failure, "");
  EXPECT_THAT(run(guided(1e-17), 1e-3, 0.1).failure,
              ::testing::AllOf(::testing::HasSubstr("the force of the joint \"plane\" (fz) is"),
                               ::testing::HasSubstr("not physical")));
}

TEST(JointForceGuard, EndsASteppedRunForTheSameReason)
{
  Machine              machine(guided(1e-17));
  coupling::SteppedRun stepped(machine, at_rest(machine), run_of(bdf(2, 1e-3), 0.1), {});
  std::string          failure;
  try
  {
    stepped.go_on_to(0.1);
  }
  catch (const coupling::ConvergenceFailure &ended)
  {
    failure = ended.what();
  }
  EXPECT_EQ(failure, run(guided(1e-17), 1e-3, 0.1).failure);
}

/// A weight in the middle of two bars that are all but level, at an angle [rad].
MachineModel toggle(double angle)
{
  MachineModel machine;
  machine.set_gravity({0., -9.81, 0.});
  const PlanePoint left{}, knee{std::cos(angle), -std::sin(angle)}, right{2. * std::cos(angle), 0.};
  const auto       middle = [](const PlanePoint &a, const PlanePoint &b) {
    return PlanePoint{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  };
  add_planar(machine, "first", 2., 0.2, middle(left, knee));
  add_planar(machine, "second", 2., 0.2, middle(knee, right));
  revolute(machine, "left", "ground", "first", left);
  revolute(machine, "knee", "first", "second", knee);
  revolute(machine, "right", "ground", "second", right);
  return machine;
}

// Weights of 40 N become 200 kN.
TEST(JointForceGuard, LetsAStretchedLinkageEnlargeForces)
{
  for (const double angle : {1e-1, 1e-2, 1e-3, 1e-4})
    EXPECT_EQ(run(toggle(angle), 1e-3, 2e-3).failure, "") << angle;
}

TEST(JointForceGuard, SaysNothingWhereAMachineRests)
{
  MachineModel machine = guided(0.);
  machine.set_gravity({0., 0., 0.});
  EXPECT_EQ(run(std::move(machine), 1e-3, 0.1).failure, "");
}

} // namespace
} // namespace gestell::tests
