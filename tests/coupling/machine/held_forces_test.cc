// What sticks: the force that holds it inside the steps, the load at which it lets go, and what of both is told.

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/propagation/force_rule.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/formula_force.h"
#include "mechanism/elements/spring_damper.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;

std::shared_ptr<mechanism::CoulombFriction> dry(double kinetic, double limit)
{
  return std::make_shared<mechanism::CoulombFriction>(mechanism::CoulombFriction::Parameters{kinetic, limit});
}

struct Way
{
  const char   *name;
  MethodOptions method;
};

MethodOptions propagated(ForceRule rule, double step)
{
  return method("exact", step, 6, {{"force", force_rule_name(rule)}});
}

MethodOptions controlled(const std::string &method, double tolerance)
{
  return tests::controlled(tests::method(method, 0.05, method == "exact" ? 6 : 5), tolerance);
}

std::string name_of(const ::testing::TestParamInfo<Way> &info)
{
  return info.param.name;
}

// ---------------------------------------------------------------------------------------------------------------------

constexpr double stiffness = 400., F = 7., Omega = 3.;

/// A mass that sticks for good, another of 1 kg that swings on it by x = 0.1 cos(20 t), and a load on the first one.
Machine swinging_on_the_held()
{
  MachineModel model;
  const int    held = model.add_slider("held", {1., 0., 0.}, 2., "ground");
  const int    free = model.add_slider("free", {1., 0., 0.}, 1., "ground");
  model.add_linear("spring", {{free, 1.}, {held, -1.}}, {stiffness, 0., 0., 0.}, "N");
  model.add_load("load", {{held, 1.}}, 0., {{Omega, F, 0.}}, "N");
  model.attach("brake", dry(1000., 1000.), {{{held, 1.}}});
  return Machine(std::move(model));
}

/// Largest error of the holding force at nine places in every step of a run of 0.5 s, relative to its size.
double error_of_holding_force(const MethodOptions &method)
{
  Machine     machine    = swinging_on_the_held();
  const auto  integrator = make_integrator(machine, method);
  EventDriver driver(machine, *integrator, EventOptions());
  driver.begin(0., Vector::Zero(2) + 0.1 * Vector::Unit(2, 1), Vector::Zero(2));
  LocalState local;
  local.resize(machine);
  double largest = 0.;
  while (integrator->time() < 0.5)
  {
    driver.advance();
    const double begin = integrator->step_begin(), end = integrator->time();
    for (int k = 0; k <= 8; ++k)
    {
      const double t = begin + k * (end - begin) / 8.;
      integrator->interpolate(t, local);
      const double expected = -stiffness * 0.1 * std::cos(20. * t) - F * std::sin(Omega * t);
      const double p        = k == 8 ? integrator->local().p[0] : local.p[0];
      largest               = std::max(largest, std::abs(p - expected));
    }
  }
  return largest / (stiffness * 0.1);
}

using FixedStepHolds = ::testing::TestWithParam<Way>;

TEST_P(FixedStepHolds, WithAForceOfTheOrderOfTheMethodAtEveryInstant)
{
  MethodOptions method = GetParam().method;
  const double  error  = error_of_holding_force(method);
  method.step /= 2.;
  const double order = std::log2(error / error_of_holding_force(method));
  EXPECT_GT(order, 1.8) << error;
}
INSTANTIATE_TEST_SUITE_P(Methods, FixedStepHolds,
                         ::testing::Values(Way{"bdf2", method("bdf", 2e-3)}, Way{"newmark", method("newmark", 2e-3)},
                                           Way{"wilson", method("wilson", 2e-3)},
                                           Way{"generalised_alpha", method("generalised-alpha", 2e-3)}),
                         name_of);

using CarriedStepHolds = ::testing::TestWithParam<Way>;

// The motion beside what is held is linear: exact propagation and dense output carry it to their rounding or tolerance.
TEST_P(CarriedStepHolds, WithTheForceOfTheEquationOfMotion)
{
  EXPECT_LT(error_of_holding_force(GetParam().method), 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Methods, CarriedStepHolds,
                         ::testing::Values(Way{"exact_collocation", propagated(ForceRule::collocation, 5e-3)},
                                           Way{"exact_average", propagated(ForceRule::average, 1e-4)},
                                           Way{"bdf_controlled", controlled("bdf", 1e-9)}),
                         name_of);

// ---------------------------------------------------------------------------------------------------------------------

/// 2 kg that come from 0.5 m/s to rest on a static limit of 30 N, kinetic 20 N, under a load of 30.03 sin(2 pi t) N
/// that exceeds it for 14 ms.
constexpr double mass = 2., limit = 30., kinetic = 20., load = 30.03, w = 2. * M_PI, v_0 = 0.5;

Machine loaded_beyond_its_limit()
{
  MachineModel model;
  const int    x = model.add_slider("mass", {1., 0., 0.}, mass, "ground");
  model.add_load("load", {{x, 1.}}, 0., {{w, load, 0.}}, "N");
  model.attach("friction", dry(kinetic, limit), {{{x, 1.}}});
  return Machine(std::move(model));
}

/// Way and velocity at t of m x'' = F sin(w t) - R from t_0 on, where the velocity is v.
Eigen::Vector2d slid(double t_0, double v, double t)
{
  const double tau = t - t_0;
  return {v * tau + (load / mass) * ((std::sin(w * t_0) - std::sin(w * t)) / (w * w) + std::cos(w * t_0) * tau / w) -
              0.5 * kinetic / mass * tau * tau,
          v + load / mass * (std::cos(w * t_0) - std::cos(w * t)) / w - kinetic / mass * tau};
}

/// Where it comes to rest, between 0 and 0.1 s.
double first_way()
{
  double low = 0., high = 0.1;
  for (int k = 0; k < 60; ++k)
    (slid(0., v_0, 0.5 * (low + high))[1] > 0. ? low : high) = 0.5 * (low + high);
  return slid(0., v_0, low)[0];
}

RunResult run_held(Machine machine, const MethodOptions &method, double end)
{
  RunOptions options  = run_of(method, end);
  options.output_step = 1e-3;
  return simulate(machine, start(0., v_0), options,
                  {machine.signal("x", "mass.displacement"), machine.signal("R", "friction.force")});
}

using BriefOverload = ::testing::TestWithParam<Way>;

TEST_P(BriefOverload, ReleasesWhatSticksAndIsNeverHeldByMore)
{
  const double    end    = 0.45; // it slides until 0.5 s and longer
  const RunResult result = run_held(loaded_beyond_its_limit(), GetParam().method, end);
  ASSERT_EQ(result.events.size(), 2u);
  EXPECT_EQ(result.events[0].kind, "stick");
  EXPECT_EQ(result.events[1].kind, "slip_forward");
  const double t_0 = std::asin(limit / load) / w, x = first_way() + slid(t_0, 0., end)[0];
  const double share = GetParam().method.tolerance > 0. ? 1e-7 : 2e-2;
  EXPECT_NEAR(result.events[1].t, t_0, 0.1 * share);
  EXPECT_NEAR(result.signals[0].final, x, share * x);
  EXPECT_LE(result.signals[1].max, limit * (1. + 1e-9));
  EXPECT_GE(result.signals[1].max, limit * (1. - share));
}
INSTANTIATE_TEST_SUITE_P(Methods, BriefOverload,
                         ::testing::Values(Way{"bdf_controlled", controlled("bdf", 1e-10)},
                                           Way{"exact_controlled", controlled("exact", 1e-8)},
                                           Way{"bdf2", method("bdf", 10e-3)}, Way{"newmark", method("newmark", 20e-3)},
                                           Way{"exact", propagated(ForceRule::collocation, 60e-3)}),
                         name_of);

// ---------------------------------------------------------------------------------------------------------------------

// A damper d between what moves and what sticks: in a step h it weighs h d/m against 1, what holds h^2/m against h d/m.
// That is a matter of units, and no step makes the force that holds d v unknown.
TEST(HeldForces, OfADamperAreKnownInTheShortestSteps)
{
  constexpr double d = 1e5, v = 0.01, h = 1e-12;
  MachineModel     model;
  const int        held = model.add_slider("held", {1., 0., 0.}, 2., "ground");
  const int        free = model.add_slider("free", {1., 0., 0.}, 1., "ground");
  model.attach("damper", std::make_shared<mechanism::SpringDamper>(mechanism::SpringDamper::Parameters{0., d}),
               {{{free, 1.}, {held, -1.}}});
  model.attach("brake", dry(2. * d * v, 2. * d * v), {{{held, 1.}}});
  Machine     machine(std::move(model));
  const auto  integrator = make_integrator(machine, method("bdf", h));
  EventDriver driver(machine, *integrator, EventOptions());
  driver.begin(0., Vector::Zero(2), v * Vector::Unit(2, 1));
  for (int i = 0; i < 5; ++i)
    driver.advance();
  EXPECT_NEAR(integrator->instant().v[0], 0., 1e-16 * v);            // rounding
  EXPECT_NEAR(integrator->local().p[1], -d * v, 5. * h * d * d * v); // v falls by d v/m in a second
}

// Kinks of |v| where v is a combination of rates that are held look at these rates, not at what an iteration leaves of
// them; where v is free, at v itself.
TEST(HeldForces, KeepGuardsOfOtherElementsFromRounding)
{
  using mechanism::Formula, mechanism::FormulaForce;
  const auto drag =
      std::make_shared<FormulaForce>(FormulaForce::Parameters{-2. * abs(Formula::variable(FormulaForce::rate))});
  MachineModel model;
  const int    a = model.add_slider("a", {1., 0., 0.}, 1., "ground"),
            b    = model.add_slider("b", {1., 0., 0.}, 1., "ground"),
            c    = model.add_slider("c", {1., 0., 0.}, 1., "ground");
  model.attach("on c", drag, {{{c, 1.}}});
  model.attach("on both", drag, {{{a, 3.}, {b, -1.}}});
  model.attach("brake between", dry(1., 1.), {{{a, 1.}, {b, -1.}}});
  model.attach("brake of b", dry(1., 1.), {{{b, 2.}}});
  Machine    machine(std::move(model));
  LocalState state;
  state.resize(machine);
  const auto gather = [&](const Vector &v) { machine.gather(0., Vector::Zero(3), v, Vector::Zero(3), state); };
  gather(Vector::Zero(3));
  machine.events().start(state);
  ASSERT_EQ(machine.forces().held().size(), 2u);
  Vector g(machine.events().n_guards());
  for (const double left : {-1e-17, 1e-17})
  {
    gather(Vector::Constant(3, left));
    machine.events().guard_values(state, g);
    EXPECT_EQ(g[0], left);
    EXPECT_EQ(g[1], 0.);
  }
}

} // namespace
} // namespace gestell::tests
