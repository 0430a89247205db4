// Ideal joints: with constraints on accelerations they drift apart; with index 3 the first multiplier is halved.

#include "apps/atlas/atlas.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/machine/machine.h"
#include "fem/values/number_text.h"
#include "mechanism/joints/ideal_joint.h"

#include <cmath>
#include <complex>

namespace gestell::apps
{
namespace
{

using Eigen::VectorXd;

constexpr double length = 1., omega = 5.; ///< m, rad/s: of the examples

/// 1 kg that goes round the origin at the end of a massless bar, without weight: x = length e^(i omega t).
coupling::Machine revolving_mass()
{
  coupling::MachineModel          model;
  mechanism::IdealJoint::Equation bar;
  model.add_point("mass", 1., {length, 0., 0.});
  const coupling::PlacedPoint place = model.place("mass", {length, 0., 0.});
  bar.name                          = "force";
  bar.measure.form                  = mechanism::RelativeMeasure::Form::distance;
  bar.offset                        = length;
  model.attach("bar",
               std::make_shared<mechanism::IdealJoint>(mechanism::Placement(), place.placement,
                                                       std::vector<mechanism::IdealJoint::Equation>{bar}),
               place.measures);
  coupling::Machine machine(std::move(model));
  return machine;
}

/// The distance from the origin, the variable of the motion.
double distance(const VectorXd &q)
{
  return std::hypot(length + q[0], q[1], q[2]);
}

VectorXd tangential_speed()
{
  return VectorXd::Unit(3, 1) * (omega * length);
}

/// An explicit Runge-Kutta method of s stages, each made of the one before: Euler, or the classical one.
struct Explicit
{
  std::string         name;
  std::vector<double> nodes, weights;

  /// Its growth of a linear motion: R(z).
  std::complex<double> root(std::complex<double> z) const
  {
    std::complex<double> stage = 1., sum = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      stage = 1. + (i > 0 ? nodes[i] * z * stage : 0.);
      sum += weights[i] * stage;
    }
    return 1. + z * sum;
  }
};

/// |x|/length after n steps of length h, with q'' and the bar's force from g'' = 0.
double stretched_by(const Explicit &method, double h, int n)
{
  const auto                machine = revolving_mass();
  coupling::ConsistentStart accelerations(machine, "explicit");
  coupling::IntegrationWork work;
  coupling::LocalState      local;
  VectorXd                  q = VectorXd::Zero(3), v = tangential_speed(), a = VectorXd::Zero(3);
  local.resize(machine);
  for (int k = 0; k < n; ++k)
  {
    VectorXd q_sum = VectorXd::Zero(3), v_sum = q_sum, q_rate = q_sum, v_rate = q_sum;
    for (std::size_t i = 0; i < method.nodes.size(); ++i)
    {
      const VectorXd q_i = q + h * method.nodes[i] * q_rate, v_i = v + h * method.nodes[i] * v_rate;
      machine.gather(0., q_i, v_i, VectorXd::Zero(3), local);
      accelerations.solve(q_i, v_i, a, local, work);
      q_rate = v_i;
      v_rate = a;
      q_sum += method.weights[i] * q_rate;
      v_sum += method.weights[i] * v_rate;
    }
    q += h * q_sum;
    v += h * v_sum;
  }
  return distance(q) / length;
}

/// The same by the program's own BDF 2, which demands g = 0.
double stretched_by_bdf(double h, int n)
{
  auto                    machine = revolving_mass();
  coupling::MethodOptions options;
  options.step             = h;
  const auto           bdf = coupling::make_integrator(machine, options);
  coupling::LocalState local;
  machine.gather(0., VectorXd::Zero(3), tangential_speed(), VectorXd::Zero(3), local);
  machine.events().start(local);
  bdf->begin(0., VectorXd::Zero(3), tangential_speed());
  for (int k = 0; k < n; ++k)
    bdf->advance();
  return distance(bdf->instant().q) / length;
}

/// Force of the bar after one implicit Euler step of index 3 from the exact state, over the true one.
double first_multiplier(double h)
{
  const auto                machine = revolving_mass();
  coupling::ImplicitStep    implicit(machine, {});
  coupling::IntegrationWork work;
  const coupling::StepForm  euler{1., h, h * h, h * h, 1., 1. / h, 1. / (h * h), h};
  coupling::LocalState      base, local;
  base.resize(machine);
  local.resize(machine);
  const VectorXd v = tangential_speed(), u_rate = machine.forces().directions().transpose() * v;
  VectorXd       f(3), x                        = VectorXd::Zero(3);
  machine.linear().mass_times(h * v, f);
  base.a  = -u_rate / h;
  local.u = h * u_rate;
  implicit.solve(implicit.condensed(euler, work), f, base, x, local, work);
  return local.lambda[0] / (-omega * omega * length);
}

} // namespace

AtlasEntry drift_of_joints()
{
  AtlasEntry     entry{"joint-drift",
                   "Joints enforced by accelerations drift open",
                   "If g = 0 is differentiated twice, the joint forces follow from g″ = 0 at every instant, and any "
                       "method for ordinary differential equations can be used. But errors of g itself are never "
                       "corrected. A mass on a rotating massless bar shows this exactly: such a method solves q″ = -ω²q, "
                       "and the bar grows by |R(iωh)| per step, with R the root of the method. Gestell enforces g = 0 "
                       "itself (index 3). Ten revolutions at 5 rad/s, length of the bar at the end:",
                   {},
                   {{"method", "step", "predicted", "measured", "BDF 2 with g = 0"}},
                   {}};
  const Explicit euler{"explicit Euler", {0.}, {1.}},
      classical{"Runge-Kutta of order 4", {0., 0.5, 0.5, 1.}, {1. / 6., 1. / 3., 1. / 3., 1. / 6.}};
  for (const auto &[method, parts] : {std::pair{euler, 4000}, {euler, 400}, {classical, 80}, {classical, 40}})
  {
    const double h         = 2. * M_PI / omega / parts,
                 predicted = std::pow(std::abs(method.root({0., omega * h})), 10 * parts),
                 measured = stretched_by(method, h, 10 * parts), held = stretched_by_bdf(h, 10 * parts);
    const std::string where = method.name + ", " + std::to_string(parts) + " steps a turn";
    // Exact up to the rounding of these steps.
    entry.comparisons.push_back({where, predicted, measured, 1e-9 * predicted});
    entry.comparisons.push_back({"BDF 2, " + std::to_string(parts) + " steps a turn", 1., held, 1e-11});
    entry.table.push_back({method.name, short_text(1e3 * h, 3) + " ms", short_text(predicted, 8),
                           short_text(measured, 8),
                           std::abs(held - 1.) < 1e-11 ? "1 to rounding" : short_text(held, 8)});
  }
  return entry;
}

AtlasEntry first_multiplier_of_a_joint()
{
  AtlasEntry entry{"joint-multiplier",
                   "The first joint forces by index 3",
                   "A method that enforces g = 0 at the end of a step computes joint forces from second differences of "
                   "positions. After a start these are wrong: implicit Euler gives the right x₁, but (x₁ - x₀ - h "
                   "v₀)/h² is half of the acceleration for every step (order zero). After every start and event "
                   "Gestell therefore computes forces from g″ = 0, at the positions and velocities of the method. The "
                   "mass on its bar, ratio of the first force to the true one:",
                   {},
                   {{"step", "predicted", "measured"}},
                   {}};
  for (const double h : {1e-2, 1e-3, 1e-4})
  {
    // x_1 = (1, omega h)/sqrt(1 + (omega h)^2): the bar reverses part of the displacement along the tangent.
    const double y = omega * h, predicted = (std::sqrt(1. + y * y) - 1.) / (y * y), measured = first_multiplier(h);
    entry.comparisons.push_back({"h = " + short_text(1e3 * h) + " ms", predicted, measured, 1e-6});
    entry.table.push_back({short_text(1e3 * h) + " ms", short_text(predicted, 6), short_text(measured, 6)});
  }
  return entry;
}

} // namespace gestell::apps
