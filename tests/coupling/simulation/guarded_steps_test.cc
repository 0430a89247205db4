// The guard's word against steps that are taken all the same: random linear machines with dampers that couple their
// modes, with elements and with joints.

#include "coupling/integration/stability/stability.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "mechanism/elements/spring_damper.h"
#include "tests/support/linear_joint.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace coupling;

struct Random
{
  std::mt19937 engine;

  double uniform(double a, double b) { return a + (b - a) * double(engine()) / 4294967296.; }
  double spread(double decades) { return std::pow(10., uniform(-0.5, 0.5) * decades); }
  bool   chance(double p) { return uniform(0., 1.) < p; }
};

Measure between(Random &random, const std::vector<int> &sliders)
{
  const auto pick = [&] { return sliders[std::size_t(random.uniform(0., double(sliders.size())))]; };
  const int  a = pick(), b = pick();
  return a == b || random.chance(0.3) ? Measure{{a, 1.}} : Measure{{a, 1.}, {b, -1.}};
}

/// Two to five sliders, each on a spring, with springs and dampers between them; some of these are elements.
Machine random_machine(Random &random, bool joints)
{
  MachineModel     model;
  std::vector<int> sliders;
  const int        n = 2 + int(random.uniform(0., 4.));
  for (int i = 0; i < n; ++i)
  {
    const double m = random.spread(2.);
    sliders.push_back(model.add_slider("m" + std::to_string(i), {1., 0., 0.}, m, "ground"));
    model.add_linear("c" + std::to_string(i), {{sliders[i], 1.}}, {m * random.spread(4.), 0., 0., 0.}, "N");
  }
  for (int i = 0; i < n; ++i)
  {
    const std::string name = "s" + std::to_string(i);
    const double      c    = random.chance(0.5) ? random.spread(4.) : 0.;
    const double      b    = random.chance(0.6) ? random.spread(5.) : 0.;
    if (random.chance(0.4))
    {
      mechanism::SpringDamper::Parameters p;
      p.stiffness = c;
      p.damping   = b;
      model.attach(name, std::make_shared<mechanism::SpringDamper>(p), {between(random, sliders)});
    }
    else
      model.add_linear(name, between(random, sliders), {c, b, 0., 0.}, "N");
  }
  if (joints)
    model.attach("gear", std::make_shared<LinearJoint>(std::vector<double>{1., -random.spread(1.)}),
                 {{{sliders[0], 1.}}, {{sliders[1], 1.}}});
  return Machine(std::move(model));
}

MethodOptions random_method(Random &random, bool joints)
{
  MethodOptions o;
  switch (int(random.uniform(0., joints ? 4. : 7.)))
  {
  case 0:
    o.order = 3 + int(random.uniform(0., 4.));
    break;
  case 1:
    o.method = "generalised-alpha";
    o.set("rho_inf", random.uniform(0., 0.95));
    break;
  case 2:
    o.method = "hht";
    o.set("alpha", -random.uniform(0.02, 0.33));
    break;
  case 3:
    o.method = "newmark";
    o.set("gamma", random.uniform(joints ? 0.55 : 0.4, 1.));
    o.set("beta", joints ? random.uniform(0.55, 1.) * method_of(o).number(o, "gamma") : random.uniform(0., 0.5));
    break;
  case 4:
    o.method = "newmark";
    o.set("gamma", random.chance(0.5) ? 0.5 : 0.6);
    o.set("beta", random.chance(0.5) ? 0. : 1. / 6.);
    break;
  case 5:
    o.method = "wilson";
    o.set("theta", random.uniform(1., 1.5));
    break;
  default:
    o.method = "central-difference";
  }
  return o;
}

double size_of(const TimeIntegrator &integrator, double h)
{
  const Instant &now = integrator.instant();
  return std::sqrt(now.q.squaredNorm() + h * h * now.v.squaredNorm()) + 1e-300; // what has died away is no nan
}

/// ln of the growth per step, over the second half of so many steps from a random state.
double measured_growth(Machine &machine, const MethodOptions &options, Random &random, int steps)
{
  Eigen::VectorXd q(machine.size()), v(machine.size());
  for (double &x : q)
    x = random.uniform(-1., 1.);
  for (double &x : v)
    x = random.uniform(-1., 1.) / options.step;
  const auto integrator = make_integrator(machine, options);
  if (machine.joints().n_rows() > 0) // the gear closes
  {
    LocalState local;
    local.resize(machine);
    const Eigen::MatrixXd Z = free_motions(machine, local);
    q                       = Z * (Z.transpose() * q).eval();
    v                       = Z * (Z.transpose() * v).eval();
  }
  integrator->begin(0., q, v);
  double middle = 0.;
  for (int k = 0; k < steps; ++k)
  {
    integrator->advance();
    const double size = size_of(*integrator, options.step);
    if (k == steps / 2)
      middle = size;
    if (size > 1e100)
      return k > steps / 2 ? std::log(size / middle) / (k - steps / 2) : std::log(1e100) / k;
  }
  return std::log(size_of(*integrator, options.step) / middle) / (steps - 1 - steps / 2);
}

double highest(const LinearSpectrum &spectrum)
{
  double omega = 0.;
  for (const LinearMachine &machine : spectrum.machines)
    omega = std::max(omega, machine.modes.omega.maxCoeff());
  return omega;
}

TEST(GuardedSteps, TheGuardsWordComesTrueWhenForced)
{
  int refused = 0, let_go = 0;
  for (unsigned seed = 0; seed < 600; ++seed)
  {
    Random               random{std::mt19937(seed)};
    const bool           joints   = random.chance(0.3);
    Machine              machine  = random_machine(random, joints);
    MethodOptions        o        = random_method(random, joints);
    const LinearSpectrum spectrum = linear_spectrum(machine, at_rest(machine));
    o.step                        = std::pow(10., random.uniform(-0.7, 1.)) / highest(spectrum);
    const StabilityGuard guard(spectrum, o);
    double               radius = 1.;
    for (const ModeAccuracy &mode : guard.modes())
      radius = std::max(radius, mode.unstable ? mode.spectral_radius : 1.);

    constexpr int steps    = 4000;
    const double  measured = measured_growth(machine, o, random, steps);
    const auto    where    = method_name(o) + ", seed " + std::to_string(seed) + ", radius " + std::to_string(radius);
    // Slower growth than e^5 in the half of the steps that is measured may hide behind what decays.
    if (std::log(radius) * steps / 2 > 5.)
    {
      ++refused;
      EXPECT_NEAR(measured, std::log(radius), 0.1 * std::log(radius) + 3. / steps) << where;
    }
    else if (radius == 1.)
    {
      ++let_go;
      EXPECT_LT(measured, 5. / steps) << where;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(let_go, 100);
}

TEST(GuardedSteps, TheStepItOffersWorksAndOneTenthMoreDoesNot)
{
  int offered = 0;
  for (unsigned seed = 1000; seed < 1250; ++seed)
  {
    Random               random{std::mt19937(seed)};
    Machine              machine  = random_machine(random, false);
    MethodOptions        o        = random_method(random, false);
    const LinearSpectrum spectrum = linear_spectrum(machine, at_rest(machine));
    o.step                        = 10. / highest(spectrum);
    const double step             = StabilityGuard(spectrum, o).largest_stable_step();
    const auto   unstable         = [&](double h)
    {
      o.step = h;
      try
      {
        StabilityGuard(spectrum, o).check();
      }
      catch (const std::invalid_argument &)
      {
        return true;
      }
      return false;
    };
    if (!unstable(10. / highest(spectrum)) || step == 0.)
      continue;
    ++offered;
    const auto where = method_name(o) + ", seed " + std::to_string(seed);
    EXPECT_FALSE(unstable(step)) << where;
    o.step = step;
    EXPECT_LT(measured_growth(machine, o, random, 4000), 5. / 4000) << where;
    EXPECT_TRUE(unstable(1.01 * step)) << where; // three digits are kept
    if (method_of(o).step_weights(o, -1.))       // BDF has islands of stability
    {
      EXPECT_TRUE(unstable(1.1 * step)) << where;
    }
  }
  EXPECT_GT(offered, 25);
}

} // namespace
} // namespace gestell::tests
