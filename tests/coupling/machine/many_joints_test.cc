// Steps of many joints, solved sparse: the same motion as condensed to the measures, at a cost linear in their number.

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/step/consistent_start.h"
#include "mechanism/elements/dynamic_motor.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/jointed_machines.h"
#include "tests/support/methods.h"
#include "tests/support/reference_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using coupling::JointSolver;
using coupling::MethodOptions;
using Vector = Eigen::VectorXd;

MethodOptions solved(const std::string &kind, double step, JointSolver solver)
{
  MethodOptions options         = tests::method(kind, step);
  options.newton.joints         = solver;
  options.newton.share_of_error = 0.; // so that both solve to the same end
  return options;
}

struct Motion
{
  std::vector<coupling::Instant> instants; ///< every `every` steps
  coupling::IntegrationWork      work;
};

Motion motion_of(Machine &machine, const Vector &v, const MethodOptions &options, int steps, int every)
{
  const auto             integrator = coupling::make_integrator(machine, options);
  coupling::EventOptions events;
  events.end = steps * options.step;
  coupling::EventDriver driver(machine, *integrator, events);
  driver.begin(0., Vector::Zero(machine.size()), v);
  Motion motion;
  for (int next = every; integrator->time() < events.end * (1. - 1e-12);)
  {
    driver.advance();
    if (integrator->time() >= next * options.step * (1. - 1e-12))
    {
      motion.instants.push_back(integrator->instant());
      next += every;
    }
  }
  motion.work = integrator->work();
  return motion;
}

double difference(const Vector &a, const Vector &b)
{
  return a.size() == 0 ? 0. : (a - b).cwiseAbs().maxCoeff() / std::max(1., a.cwiseAbs().maxCoeff());
}

/// What rounding makes of positions of about 1 m, times 1/h in velocities and m/h^2 in forces (h = 1e-5 s for the
/// squeezer of some grams, 1e-3 s for 1 kg), and what is left of Newton's tolerance of 1e-13.
void expect_same(Machine machine, const Vector &v, const std::string &kind, double h, int steps)
{
  const auto dense  = motion_of(machine, v, solved(kind, h, JointSolver::condensed), steps, steps / 10);
  const auto sparse = motion_of(machine, v, solved(kind, h, JointSolver::sparse), steps, steps / 10);
  ASSERT_EQ(dense.instants.size(), sparse.instants.size());
  for (std::size_t i = 0; i < dense.instants.size(); ++i)
  {
    const auto &a = dense.instants[i], &b = sparse.instants[i];
    EXPECT_NEAR(a.t, b.t, 1e-9 * h);
    EXPECT_LT(difference(a.q, b.q), 1e-13) << "at " << a.t;
    EXPECT_LT(difference(a.v, b.v), 1e-10) << "at " << a.t;
    EXPECT_LT(difference(a.local.u, b.local.u), 1e-13) << "at " << a.t;
    EXPECT_LT(difference(a.local.v, b.local.v), 1e-10) << "at " << a.t;
    EXPECT_LT(difference(a.local.p, b.local.p), 3e-7) << "at " << a.t;
    EXPECT_LT(difference(a.local.lambda, b.local.lambda), 3e-7) << "at " << a.t;
  }
  EXPECT_LE(sparse.work.newton, dense.work.newton + dense.work.newton / 5) << "Newton's method converges as well";
}

/// A carrier that slides on a spring, with so many pendulums on it: more equations than are eliminated after a motion.
Machine pendulums_on_carrier(int n)
{
  MachineModel model;
  model.set_gravity({0., -9.81, 0.});
  const int carrier = add_planar(model, "carrier", 20., 5., {});
  for (int i = 0; i < 3; ++i)
    model.add_linear("mount " + std::to_string(i), {{carrier + i, 1.}}, {2e4, 10., 0., 0.}, "N");
  for (int i = 0; i < n; ++i)
  {
    const std::string name = "bar " + std::to_string(i);
    add_planar(model, name, 1., 1. / 12., {0.1 * i + 0.5, 0.});
    revolute(model, "pin " + std::to_string(i), "carrier", name, {0.1 * i, 0.});
  }
  return Machine(std::move(model));
}

/// Bars on hinges, each driven by a motor whose torque, a virtual coordinate, follows with a lag.
Machine driven_bars(int n)
{
  MachineModel model;
  model.set_gravity({0., -9.81, 0.});
  const mechanism::KlossMotor::Parameters motor{20., 0.2, 10., 1.};
  for (int i = 0; i < n; ++i)
  {
    const std::string name = "bar " + std::to_string(i);
    const int         bar  = add_planar(model, name, 1., 1. / 12., {i + 0.5, 0.});
    revolute(model, "pin " + std::to_string(i), "ground", name, {double(i), 0.});
    const int torque = model.add_lag("torque " + std::to_string(i), 0.02);
    model.attach("motor " + std::to_string(i), std::make_shared<mechanism::DynamicMotor>(motor),
                 {{{bar + 2, 1.}}, {{torque, 1.}}});
  }
  return Machine(std::move(model));
}

// M is singular on virtual coordinates; the forces of the hinges at the first instant are those of a falling bar, g/4,
// all the same, as the torque is still zero.
TEST(ManyJoints, VirtualCoordinatesStayApartFromAConsistentStart)
{
  expect_same(driven_bars(5), Vector::Zero(20), "bdf", 1e-3, 200);
  for (const JointSolver solver : {JointSolver::condensed, JointSolver::sparse})
  {
    Machine    machine    = driven_bars(3);
    const auto integrator = coupling::make_integrator(machine, solved("bdf", 1e-3, solver));
    integrator->begin(0., Vector::Zero(12), Vector::Zero(12));
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(integrator->local().lambda[2 * i + 1], 9.81 / 4., 1e-12);
  }
  Machine machine = driven_bars(1);
  EXPECT_THROW(coupling::make_integrator(machine, solved("generalised-alpha", 1e-3, JointSolver::automatic)),
               std::invalid_argument);
}

TEST(ManyJoints, SparseStepsAreCondensedSteps)
{
  for (const std::string kind : {"bdf", "generalised-alpha"})
  {
    {
      SCOPED_TRACE("four-bars");
      expect_same(n_four_bar(2), swinging_four_bars(n_four_bar(2)), kind, 1e-3, 400);
    }
    {
      SCOPED_TRACE("slider-crank");
      Machine machine = slider_crank(slider_crank_case("crank2"));
      expect_same(std::move(machine), Vector::Zero(9), kind, 1e-4, 1000);
    }
    {
      SCOPED_TRACE("pendulums on a carrier");
      expect_same(pendulums_on_carrier(15), Vector::Zero(48), kind, 1e-3, 300);
    }
    {
      SCOPED_TRACE("squeezer, with a spring");
      expect_same(andrews_squeezer(), Vector::Zero(21), kind, 1e-5, 1000);
    }
  }
}

// Dry friction brings the crank to rest, once and for all.
TEST(ManyJoints, MeasuresThatStickAreHeld)
{
  for (const std::string kind : {"bdf", "generalised-alpha"})
  {
    const auto   p       = slider_crank_case("crank1");
    Machine      machine = slider_crank(p, 0.5);
    const Vector v       = slider_crank_velocity(p, 10.);
    const auto   dense   = motion_of(machine, v, solved(kind, 1e-3, JointSolver::condensed), 1000, 50);
    const auto   sparse  = motion_of(machine, v, solved(kind, 1e-3, JointSolver::sparse), 1000, 50);
    ASSERT_EQ(machine.forces().held().size(), 1u) << "the crank should have come to rest";
    ASSERT_EQ(dense.instants.size(), sparse.instants.size());
    for (std::size_t i = 0; i < dense.instants.size(); ++i)
    {
      const auto &a = dense.instants[i], &b = sparse.instants[i];
      EXPECT_NEAR(a.t, b.t, 1e-9);
      EXPECT_LT(difference(a.q, b.q), 1e-9) << "at " << a.t;
      EXPECT_LT(difference(a.v, b.v), 1e-8) << "at " << a.t;
      EXPECT_LT(difference(a.local.p, b.local.p), 1e-6) << "at " << a.t;
    }
    EXPECT_LT(sparse.instants.back().v.cwiseAbs().maxCoeff(), 1e-10); // rounding of 3 rad over a step
  }
}

struct FourBarErrors
{
  double q = 0., v = 0.;
};

FourBarErrors errors_of_forty(const MethodOptions &options)
{
  static const auto rows    = read_reference("dae/a02_n_four_bar.csv");
  Machine           machine = n_four_bar(40);
  const Vector      v       = swinging_four_bars(machine);
  const auto        every   = int(std::lround(0.25 / options.step));
  const auto        motion  = motion_of(machine, v, options, 8 * every, every);
  const int         angle   = machine.model().coordinate("crank 0.angle");
  FourBarErrors     errors;
  int               found = 0;
  for (const auto &r : rows)
    for (const auto &now : motion.instants)
      if (r.number("N") == 40 && std::abs(r.number("t") - now.t) < 1e-9)
      {
        ++found;
        errors.q = std::max(errors.q, std::abs(now.q[angle] + r.number("phi_clockwise_from_upright")));
        errors.v = std::max(errors.v, std::abs(now.v[angle] + r.number("phi_dot")));
      }
  EXPECT_EQ(found, 8);
  return errors;
}

TEST(ManyJoints, FortyFourBarsMeetTheirReferenceWithOrderTwo)
{
  for (const std::string kind : {"bdf", "generalised-alpha"})
  {
    const double h      = kind == "bdf" ? 1e-3 : 2e-3;
    const auto   coarse = errors_of_forty(solved(kind, h, JointSolver::automatic));
    const auto   fine   = errors_of_forty(solved(kind, h / 2., JointSolver::automatic));
    // 0.15: the next term of the expansion at these steps
    EXPECT_NEAR(std::log2(coarse.q / fine.q), 2., 0.15) << fine.q;
    EXPECT_NEAR(std::log2(coarse.v / fine.v), 2., 0.15) << fine.v;
    RecordProperty(kind == "bdf" ? "bdf" : "alpha", std::to_string(fine.q));
  }
}

TEST(ManyJoints, AStepTakesNothingFromTheHeapAndFactorsOnce)
{
  for (const std::string kind : {"bdf", "generalised-alpha"})
  {
    Machine    machine    = n_four_bar(20);
    const auto integrator = coupling::make_integrator(machine, solved(kind, 1e-3, JointSolver::automatic));
    integrator->begin(0., Vector::Zero(machine.size()), swinging_four_bars(machine));
    for (int i = 0; i < 10; ++i)
      integrator->advance();
    const auto work   = integrator->work();
    const long before = allocations;
    for (int i = 0; i < 100; ++i)
      integrator->advance();
    EXPECT_TRUE(!counts_allocations || allocations == before);
    EXPECT_EQ(integrator->work().factorisations - work.factorisations, 100);
    EXPECT_LE(integrator->work().newton - work.newton, 300);
    EXPECT_EQ(integrator->work().solves - work.solves, integrator->work().newton - work.newton);
  }
}

/// The machine with the force of that joint as a signal, wanted in every step.
Machine reads_force(Machine machine, const std::string &joint)
{
  machine.will_read({machine.signal("F", joint + ".resultant")});
  return machine;
}

/// A carrier so stiff that a step does not resolve it: A is far from M, and the factor of the step of no use for
/// forces.
Machine pendulums_on_stiff_carrier()
{
  MachineModel model;
  model.set_gravity({0., -9.81, 0.});
  const int carrier = add_planar(model, "carrier", 20., 5., {});
  for (int i = 0; i < 3; ++i)
    model.add_linear("mount " + std::to_string(i), {{carrier + i, 1.}}, {2e9, 1e3, 0., 0.}, "N");
  add_planar(model, "bar", 1., 1. / 12., {0.5, 0.});
  revolute(model, "pin", "carrier", "bar", {});
  return Machine(std::move(model));
}

/// The forces after every step against those of the equation of motion, g'' = 0, solved afresh at the same q and q'.
void expect_forces_of_the_motion(Machine machine, const Vector &v, MethodOptions options, JointSolver solver)
{
  options.newton.joints                = solver;
  const auto                integrator = coupling::make_integrator(machine, options);
  coupling::ConsistentStart exact(machine, "test", solver);
  coupling::IntegrationWork work;
  Vector                    a = v;
  integrator->begin(0., Vector::Zero(machine.size()), v);
  double largest = 0., worst = 0.;
  for (int step = 0; step < 300; ++step)
  {
    integrator->advance();
    coupling::Instant now = integrator->instant();
    exact.solve(now.q, now.v, a, now.local, work);
    largest = std::max(largest, now.local.lambda.cwiseAbs().maxCoeff());
    worst   = std::max(worst, (now.local.lambda - integrator->local().lambda).cwiseAbs().maxCoeff());
    EXPECT_LT((now.local.a - integrator->local().a).cwiseAbs().maxCoeff(), 1e-9 * largest) << step;
  }
  EXPECT_LT(worst, 1e-11 * largest); // converged to 1e-12 of the accelerations in the sum
}

TEST(ManyJoints, ForcesWantedInEveryStepAreThoseOfTheMotion)
{
  for (const std::string kind : {"bdf", "generalised-alpha"})
    for (const JointSolver solver : {JointSolver::condensed, JointSolver::sparse})
    {
      SCOPED_TRACE(kind + (solver == JointSolver::sparse ? ", sparse" : ", condensed"));
      const Vector v = swinging_four_bars(n_four_bar(2));
      expect_forces_of_the_motion(reads_force(n_four_bar(2), "foot 0"), v, method(kind, 1e-3), solver);
      expect_forces_of_the_motion(reads_force(andrews_squeezer(), "O"), Vector::Zero(21), method(kind, 1e-5), solver);
      expect_forces_of_the_motion(reads_force(pendulums_on_stiff_carrier(), "pin"), Vector::Zero(6), method(kind, 1e-3),
                                  solver);
      expect_forces_of_the_motion(reads_force(driven_bars(2), "pin 0"), Vector::Zero(8), method("bdf", 1e-3), solver);
    }
}

// A bound for Newton's iterations, not their number: a second one only where the first did not reach the tolerance.
TEST(ManyJoints, ForcesWantedInEveryStepNeedNoSecondIterationFactorOrMemory)
{
  for (const JointSolver solver : {JointSolver::condensed, JointSolver::sparse})
  {
    Machine       machine = reads_force(n_four_bar(2), "foot 0");
    MethodOptions options = bdf(2, 5e-4);
    options.newton.joints = solver;
    const auto integrator = coupling::make_integrator(machine, options);
    const bool is_sparse  = solver == JointSolver::sparse;
    integrator->begin(0., Vector::Zero(machine.size()), swinging_four_bars(machine));
    for (int i = 0; i < 50; ++i)
      integrator->advance();
    const auto work   = integrator->work();
    const long before = allocations;
    for (int i = 0; i < 1000; ++i)
      integrator->advance();
    EXPECT_TRUE(!counts_allocations || allocations == before);
    EXPECT_LE(integrator->work().newton - work.newton, 1100);
    EXPECT_EQ(integrator->work().factorisations - work.factorisations, is_sparse ? 1000 : 0);
    EXPECT_LE(integrator->work().solves - work.solves, is_sparse ? 3000 : 1000);
  }
}

TEST(ManyJoints, HaveNoFrequenciesOfTheirOwn)
{
  const Machine machine = n_four_bar(101); // more coordinates than dense modes are found of
  const auto    lines   = machine.linear().spectrum();
  ASSERT_EQ(int(lines.size()), machine.size());
  for (const auto &line : lines)
    EXPECT_EQ(line.omega, 0.);
}

TEST(ManyJoints, DependentJointsAreNamed)
{
  MachineModel model;
  add_planar(model, "bar", 1., 1., {0.5, 0.});
  revolute(model, "left", "ground", "bar", {0., 0.});
  revolute(model, "right", "ground", "bar", {1., 0.});
  Machine    machine(std::move(model));
  const auto integrator = coupling::make_integrator(machine, solved("bdf", 1e-3, JointSolver::sparse));
  expect_refusal<coupling::ConvergenceFailure>([&] { integrator->begin(0., Vector::Zero(3), Vector::Zero(3)); },
                                               "(fx)");
}

} // namespace
} // namespace gestell::tests
