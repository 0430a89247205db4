// Loads as they act and as they are told.

#include "coupling/frame/reduced_frame.h"
#include "coupling/machine/machine.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

TEST(Load, AsItIsReportedIsThatWhichActs)
{
  MachineModel model;
  const int    x = model.add_slider("a", {1., 0., 0.}, 3., "ground");
  const int    y = model.add_slider("b", {0., 1., 0.}, 5., "ground");
  model.add_load("shaker", {{x, 1.}, {y, -2.}}, 7., {{60., 100., 0.4}, {13., -20., -2.1}}, "N");
  const Machine   machine(std::move(model));
  const Signal    reported = machine.signal("F", "shaker.force");
  Eigen::VectorXd f(2), zero = Eigen::VectorXd::Zero(2);
  LocalState      local;
  local.resize(machine);
  for (const double t : {0., 0.013, 0.4, 2.})
  {
    local.t        = t;
    const double F = 7. + 100. * std::sin(60. * t + 0.4) - 20. * std::sin(13. * t - 2.1);
    machine.linear().excitation().at(t, f);
    EXPECT_NEAR(machine.evaluate(reported, zero, zero, local), F, 1e-11) << t;
    EXPECT_NEAR(f[x], F, 1e-11) << t;
    EXPECT_NEAR(f[y], -2. * F, 1e-11) << t;
  }
}

/// A mass on a spring: what the spring does to the frame is told with the weight that it carries beside the mass.
TEST(FrameForce, HasTheWeightAndTheConstantOfItsRow)
{
  ReducedFrame frame;
  frame.n_interface = 1;
  frame.M           = Eigen::MatrixXd::Constant(1, 1, 4.);
  frame.B           = Eigen::MatrixXd::Zero(1, 1);
  frame.C           = Eigen::MatrixXd::Constant(1, 1, 500.);
  fem::Interface tip;
  tip.name                      = "tip";
  tip.coordinate[fem::uz]       = 0;
  frame.interfaces              = {tip};
  frame.translations_load       = Eigen::MatrixXd::Zero(1, 3);
  frame.translations_load(0, 2) = 4.;
  frame.n_full                  = 1;
  fem::FrameOutput foot{"support.foot.z", "N", Eigen::VectorXd::Constant(1, -500.), Eigen::VectorXd::Constant(1, -2.),
                        Eigen::Vector3d(1., -3., -0.5)};
  foot.constant = 20.;
  frame.outputs = {foot};
  MachineModel model;
  model.set_frame(frame);
  model.set_gravity({2., 1., -9.81});
  const Machine   machine(std::move(model));
  const Signal    reported = machine.signal("F", "frame.support.foot.z");
  Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 4. * -9.81 / 500.), zero = Eigen::VectorXd::Zero(1), v = zero;
  LocalState      local;
  local.resize(machine);
  const double nearby = 2. * 1. - 3. * 1. + 0.5 * 9.81; // what the row tells of an acceleration field
  EXPECT_NEAR(machine.evaluate(reported, q, v, local), 4. * 9.81 + nearby + 20., 1e-12);
  v[0] = 0.7;
  EXPECT_NEAR(machine.evaluate(reported, zero, v, local), -1.4 + nearby + 20., 1e-12);
}

} // namespace
} // namespace gestell::tests
