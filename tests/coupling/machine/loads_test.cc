// Loads as they act and as they are told.

#include "coupling/machine/machine.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gestell::tests
{
namespace
{

using namespace coupling;

TEST(Load, AsItIsToldIsThatWhichActs)
{
  MachineModel model;
  const int    x = model.add_slider("a", {1., 0., 0.}, 3., "ground");
  const int    y = model.add_slider("b", {0., 1., 0.}, 5., "ground");
  model.add_load("shaker", {{x, 1.}, {y, -2.}}, 7., {{60., 100., 0.4}, {13., -20., -2.1}}, "N");
  const Machine   machine(std::move(model));
  const Signal    told = machine.signal("F", "shaker.force");
  Eigen::VectorXd f(2), zero = Eigen::VectorXd::Zero(2);
  LocalState      local;
  local.resize(machine);
  for (const double t : {0., 0.013, 0.4, 2.})
  {
    local.t        = t;
    const double F = 7. + 100. * std::sin(60. * t + 0.4) - 20. * std::sin(13. * t - 2.1);
    machine.linear().excitation().at(t, f);
    EXPECT_NEAR(machine.evaluate(told, zero, zero, local), F, 1e-11) << t;
    EXPECT_NEAR(f[x], F, 1e-11) << t;
    EXPECT_NEAR(f[y], -2. * F, 1e-11) << t;
  }
}

} // namespace
} // namespace gestell::tests
