#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/machine/configuration/assembly.h"
#include "tests/support/jointed_machines.h"
#include "tests/support/methods.h"
#include "tests/support/reference_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using coupling::MethodOptions;

MethodOptions alpha(double rho, double step)
{
  return method("generalised-alpha", step, 2, {{"rho_inf", rho}});
}

using Look = std::function<void(double t, const Machine &, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                                const coupling::LocalState &)>;

void run(Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const MethodOptions &method, double end,
         double every, const Look &look)
{
  const auto             integrator = coupling::make_integrator(machine, method);
  coupling::EventOptions events;
  events.end = end;
  coupling::EventDriver driver(machine, *integrator, events);
  driver.begin(0., q, v);
  double next = 0.;
  while (true)
  {
    if (integrator->time() >= next - 1e-9 * method.step)
    {
      const auto &now = integrator->instant();
      look(now.t, machine, now.q, now.v, now.local);
      next += every;
    }
    if (integrator->time() >= end * (1. - 1e-12))
      return;
    driver.advance();
  }
}

double value(const Machine &machine, const std::string &path, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
             const coupling::LocalState &local)
{
  return machine.evaluate(machine.signal(path, path), q, v, local);
}

/// Largest deviations from the reference: of positions, velocities and forces, each relative to its largest value.
struct Errors
{
  double q = 0., v = 0., force = 0.;
};

double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

/// Errors fall at the order of the method, in positions, velocities and reactions.
void expect_order(const std::string &method, double expected, const Errors &coarse, const Errors &fine)
{
  // 0.15: the next term of the expansion at these steps, and that the largest error may move to another instant.
  EXPECT_NEAR(order(coarse.q, fine.q), expected, 0.15) << method << ": positions " << fine.q;
  EXPECT_NEAR(order(coarse.v, fine.v), expected, 0.15) << method << ": velocities " << fine.v;
  if (coarse.force > 0.)
  {
    EXPECT_NEAR(order(coarse.force, fine.force), expected, 0.15) << method << ": reactions " << fine.force;
  }
}

/// @param wanted  the tension in every step: it is that of the motion at its end, not of the formula
Errors pendulum_errors(const MethodOptions &method, bool wanted = false)
{
  static const auto rows    = read_reference("dae/a01_pendulum.csv");
  Machine           machine = pendulum();
  if (wanted)
    machine.will_read({machine.signal("F", "rod.force")});
  Errors      errors;
  std::size_t row = 0;
  run(machine, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3), method, 2., 0.25,
      [&](double, const Machine &m, const auto &q, const auto &v, const auto &local)
      {
        const auto &r = rows[row++];
        errors.q      = std::max(errors.q, std::abs(value(m, "bob.x", q, v, local) - r.number("x")));
        errors.v      = std::max(errors.v, std::abs(value(m, "bob.vx", q, v, local) - r.number("vx")) / 4.4);
        errors.force =
            std::max(errors.force, std::abs(-value(m, "rod.force", q, v, local) - r.number("rod_tension")) / 29.4);
        // Index 3: positions do not drift; rounding of a rod of 1 m.
        EXPECT_NEAR(std::hypot(q[0] - 1., q[1]), 1., 4e-15);
      });
  return errors;
}

TEST(IdealJoint, PendulumKeepsTheOrderInPositionVelocityAndTension)
{
  for (const int k : {1, 2})
    expect_order("BDF " + std::to_string(k), k, pendulum_errors(bdf(k, 5e-4)), pendulum_errors(bdf(k, 2.5e-4)));
  expect_order("BDF 3", 3., pendulum_errors(bdf(3, 5e-3)), pendulum_errors(bdf(3, 2.5e-3)));
  expect_order("generalised alpha", 2., pendulum_errors(alpha(0.8, 1e-3)), pendulum_errors(alpha(0.8, 5e-4)));
  EXPECT_LT(pendulum_errors(bdf(4, 1e-3)).q, 1e-6);
}

TEST(IdealJoint, ATensionWantedInEveryStepKeepsTheOrderToo)
{
  for (const int k : {1, 2})
    expect_order("BDF " + std::to_string(k), k, pendulum_errors(bdf(k, 5e-4), true),
                 pendulum_errors(bdf(k, 2.5e-4), true));
  expect_order("generalised alpha", 2., pendulum_errors(alpha(0.8, 1e-3), true),
               pendulum_errors(alpha(0.8, 5e-4), true));
}

Errors four_bar_errors(int N, const MethodOptions &method)
{
  static const auto rows    = read_reference("dae/a02_n_four_bar.csv");
  Machine           machine = n_four_bar(N);
  const auto        v       = swinging_four_bars(machine);
  Errors            errors;
  int               found = 0;
  run(machine, Eigen::VectorXd::Zero(machine.size()), v, method, 2., 0.25,
      [&](double t, const Machine &m, const auto &q, const auto &v, const auto &local)
      {
        for (const auto &r : rows)
          if (r.number("N") == N && std::abs(r.number("t") - t) < 1e-9)
          {
            ++found;
            errors.q = std::max(
                errors.q, std::abs(value(m, "crank 0.angle", q, v, local) + r.number("phi_clockwise_from_upright")));
            errors.v = std::max(errors.v, std::abs(value(m, "crank 0.speed", q, v, local) + r.number("phi_dot")) / 6.);
          }
      });
  EXPECT_EQ(found, 9);
  return errors;
}

// A turn and more: it passes both stretched positions, where the joints say too little, on the right branch.
TEST(IdealJoint, FourBarPassesItsStretchedPositions)
{
  for (const int N : {1, 2})
  {
    expect_order("BDF 2", 2., four_bar_errors(N, bdf(2, 5e-4)), four_bar_errors(N, bdf(2, 2.5e-4)));
    expect_order("generalised alpha", 2., four_bar_errors(N, alpha(0.8, 1e-3)), four_bar_errors(N, alpha(0.8, 5e-4)));
  }
}

double andrews_error(const MethodOptions &method)
{
  Machine               machine = andrews_squeezer();
  const Eigen::VectorXd zero    = Eigen::VectorXd::Zero(machine.size());
  double                error   = 0.;
  run(machine, zero, zero, method, 0.03, 0.03,
      [&](double t, const Machine &m, const auto &q, const auto &v, const auto &local)
      {
        if (t == 0.)
          return;
        // Published end values, angles of the bodies from their start.
        const auto angle = [&](const std::string &body, double begin, double end)
        { error = std::max(error, std::abs(value(m, body + ".angle", q, v, local) + begin - end)); };
        angle("K1", -0.0617138900142764496, 15.81077119629904);
        angle("K2", -0.0617138900142764496, 15.81077119629904 - 15.75637105984298);
        angle("K3", 0.455279819163070380, 0.04082224013073101);
      });
  return error;
}

TEST(IdealJoint, AndrewsSqueezer)
{
  const double coarse = andrews_error(alpha(0.8, 1e-5)), fine = andrews_error(alpha(0.8, 5e-6));
  EXPECT_NEAR(order(coarse, fine), 2., 0.1) << fine;
  EXPECT_LT(andrews_error(bdf(3, 1e-6)), 1e-6);
}

Errors slider_crank_errors(const std::string &name, const MethodOptions &method)
{
  static const auto rows    = read_reference("dae/slider_crank.csv");
  const auto        p       = slider_crank_case(name);
  Machine           machine = slider_crank(p);
  const auto        v       = slider_crank_velocity(p, name == "crank1" ? 30. : 5.);
  Errors            errors, largest;
  run(machine, Eigen::VectorXd::Zero(machine.size()), v, method, 0.5, 0.1,
      [&](double t, const Machine &m, const auto &q, const auto &v, const auto &local)
      {
        const auto compare = [&](const std::string &signal, const ReferenceRow &r, const std::string &column,
                                 double Errors::*kind, double offset = 0.)
        {
          errors.*kind  = std::max(errors.*kind, std::abs(value(m, signal, q, v, local) + offset - r.number(column)));
          largest.*kind = std::max(largest.*kind, std::abs(r.number(column)));
        };
        for (const auto &r : rows)
          if (r["case"] == name && std::abs(r.number("t") - t) < 1e-9)
          {
            compare("crank.angle", r, "phi", &Errors::q, p.phi);
            compare("crank.speed", r, "omega", &Errors::v);
            compare("crank pin.fx", r, "crankpin_on_rod_x", &Errors::force);
            compare("crank pin.fy", r, "crankpin_on_rod_y", &Errors::force);
            compare("slider pin.fx", r, "slider_on_rod_x", &Errors::force);
            compare("slider pin.fy", r, "slider_on_rod_y", &Errors::force);
            compare("guide.fy", r, "guide_on_slider_y", &Errors::force);
            compare("bearing.fx", r, "bearing_on_crank_x", &Errors::force);
            compare("bearing.fy", r, "bearing_on_crank_y", &Errors::force);
          }
      });
  return {errors.q / largest.q, errors.v / largest.v, errors.force / largest.force};
}

TEST(IdealJoint, SliderCrankWithAllJointForces)
{
  for (const std::string name : {"crank1", "crank2"})
  {
    const double h = name == "crank1" ? 5e-5 : 2e-5;
    expect_order(name + " BDF 2", 2., slider_crank_errors(name, bdf(2, h)), slider_crank_errors(name, bdf(2, h / 2.)));
    expect_order(name + " generalised alpha", 2., slider_crank_errors(name, alpha(0.8, h)),
                 slider_crank_errors(name, alpha(0.8, h / 2.)));
  }
}

TEST(IdealJoint, MethodsThatCannotHoldJointsSaySo)
{
  Machine       machine = pendulum();
  MethodOptions newmark, wilson, central, exact;
  newmark.method = "newmark", wilson.method = "wilson", central.method = "central-difference", exact.method = "exact";
  for (MethodOptions *method : {&newmark, &wilson, &central, &exact})
  {
    method->step = 1e-3;
    EXPECT_THROW(coupling::make_integrator(machine, *method), std::invalid_argument) << coupling::method_name(*method);
  }
}

TEST(IdealJoint, JointsThatSayTheSameTwiceAreNamed)
{
  MachineModel model;
  add_planar(model, "bar", 1., 1., {0.5, 0.});
  revolute(model, "left", "ground", "bar", {0., 0.});
  revolute(model, "right", "ground", "bar", {1., 0.});
  Machine    machine(std::move(model));
  const auto integrator = coupling::make_integrator(machine, bdf(2, 1e-3));
  expect_refusal<coupling::ConvergenceFailure>(
      [&] { integrator->begin(0., Eigen::VectorXd::Zero(3), Eigen::VectorXd::Zero(3)); }, "\"right\" (fx)");
}

// The N four-bar from a start in which nothing fits: cranks hang, the couplers stay where they were drawn.
TEST(Assembly, ClosesJointsAndKeepsWhatIsGiven)
{
  Machine              machine = n_four_bar(2);
  coupling::KnownStart known;
  known.state.q = known.state.v = Eigen::VectorXd::Zero(machine.size());
  known.q_given.assign(machine.size(), 0);
  known.v_given        = known.q_given;
  const int angle      = machine.model().coordinate("crank 1.angle");
  known.state.q[angle] = -0.7;
  known.state.v[angle] = -2.;
  known.q_given[angle] = known.v_given[angle] = 1;
  const auto start                            = coupling::assemble(machine, known);
  EXPECT_EQ(start.q[angle], -0.7);
  EXPECT_EQ(start.v[angle], -2.);
  for (const std::string crank : {"crank 0", "crank 2"}) // parallel, on the branch nearest to the drawing
  {
    EXPECT_NEAR(start.q[machine.model().coordinate(crank + ".angle")], -0.7, 1e-12);
    EXPECT_NEAR(start.v[machine.model().coordinate(crank + ".angle")], -2., 1e-12);
  }
  EXPECT_NEAR(start.q[machine.model().coordinate("coupler 1.ux")], std::sin(0.7), 1e-12);
}

TEST(Assembly, NamesTheJointThatStaysOpenAndTheOneThatIsOneTooMany)
{
  MachineModel model;
  add_planar(model, "bar", 1., 1., {0.5, 0.});
  revolute(model, "left", "ground", "bar", {0., 0.});
  revolute(model, "right", "ground", "bar", {1., 0.});
  Machine              machine(std::move(model));
  coupling::KnownStart known;
  known.state.q = known.state.v = Eigen::VectorXd::Zero(3);
  known.q_given                 = {0, 0, 1};
  known.v_given.assign(3, 0);
  const auto assembled = [&] { coupling::assemble(machine, known); };
  expect_refusal(assembled, "one equation is redundant:\n  \"right\" (fx), which constrains \"bar\", follows from the "
                            "equations of \"left\"");
  known.state.q[2] = 0.3;
  expect_refusal(assembled, "has a gap of");
}

} // namespace
} // namespace gestell::tests
