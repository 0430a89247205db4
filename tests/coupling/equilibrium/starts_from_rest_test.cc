// Random machines of sliders, springs and dry friction, at rest until a load begins: controlled steps never fail, their
// errors follow the tolerance, and they cost no more than those of a motion that is under way.

#include "coupling/integration/events/motion.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/machine/machine.h"
#include "mechanism/elements/coulomb_friction.h"
#include "mechanism/elements/speed_drive.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// +F(t) on its measure.
struct TimeForce : mechanism::DifferentiableElement<TimeForce, 1>
{
  explicit TimeForce(std::function<double(double)> of_time) : F(std::move(of_time)) {}

  template <typename Number>
  void law(const mechanism::Measures<Number> &m, const double *, Number *p) const
  {
    p[0] = Number(F(m.t));
  }
  mechanism::Work                  work() const override { return mechanism::Work::input; }
  std::vector<mechanism::Quantity> quantities() const override { return {{"force", "N"}}; }
  double quantity(int, const mechanism::LocalMotion &m, const double *) const override { return F(m.t); }

  std::function<double(double)> F;
};

enum class Load
{
  harmonic,
  pulse,      ///< F sin^2, from the begin on
  late_pulse, ///< from 0.3 of the run on
  bell,       ///< F exp(-s^2), smooth at all times
  step,
  none ///< but a motion that is under way
};
const Load all_loads[] = {Load::harmonic, Load::pulse, Load::late_pulse, Load::bell, Load::step};

struct Random
{
  std::mt19937 engine;

  double between(double a, double b) { return a + (b - a) * (engine() / 4294967296.); }
  double over_decades(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  int    whole(int a, int b) { return a + int(engine() % unsigned(b - a + 1)); }
};

struct Trial
{
  std::shared_ptr<Machine> machine;
  Vector                   q, v;
  double                   end = 0., longest_step = 0., least = 0.; ///< [s], [s], [m]: smaller motions are none
};

std::function<double(double)> course(Load load, double F, double tau, double end)
{
  const double begin = load == Load::late_pulse ? 0.3 * end : 0.;
  switch (load)
  {
  case Load::pulse:
  case Load::late_pulse:
    return [=](double t)
    {
      const double s = (t - begin) / tau;
      return s <= 0. || s >= 1. ? 0. : F * std::pow(std::sin(M_PI * s), 2);
    };
  case Load::bell:
    return [=](double t) { return F * std::exp(-std::pow((t - 0.5 * end) / (0.2 * tau), 2)); };
  default:
    return [=](double) { return F; };
  }
}

/// One to five masses of 0.1 to 100 kg, in a chain or on ground, with friction of 1 to 60 % of the load on some of
/// them.
Trial machine(Load load, unsigned seed, bool friction)
{
  Random random{std::mt19937(1000u * unsigned(load) + seed)};
  random.engine.discard(10);
  Trial               trial;
  MachineModel        m;
  const int           n = random.whole(1, 5);
  std::vector<int>    x;
  std::vector<double> mass;
  for (int i = 0; i < n; ++i)
  {
    mass.push_back(random.over_decades(0.1, 100.));
    x.push_back(m.add_slider("m" + std::to_string(i), {1., 0., 0.}, mass.back(), "ground"));
  }
  const double slowest = 2. * M_PI * random.over_decades(1., 20.), period = 2. * M_PI / slowest;
  double       stiffest = 0.;
  for (int i = 0; i < n; ++i)
  {
    const double  omega = slowest * random.over_decades(1., 10.), k = mass[i] * omega * omega;
    const Measure u = i == 0 || random.whole(0, 3) == 0 ? Measure{{x[i], 1.}} : Measure{{x[i], 1.}, {x[i - 1], -1.}};
    m.add_linear("k" + std::to_string(i), u, {k, 2. * random.over_decades(0.002, 0.1) * mass[i] * omega, 0., 0.}, "N");
    stiffest = std::max(stiffest, k);
  }
  const double F = random.over_decades(1., 1e4), Omega = slowest * random.over_decades(0.3, 3.);
  const int    at    = random.whole(0, n - 1);
  trial.end          = period * random.between(2., 5.);
  const double tau   = period * random.over_decades(0.3, 1.);
  trial.longest_step = trial.end / 50.;
  if (load == Load::harmonic || load == Load::none)
  {
    m.add_load("load", {{x[at], 1.}}, 0., {{Omega, F, random.whole(0, 1) ? 0. : 1.}}, "N");
    trial.longest_step = std::min(trial.longest_step, 0.25 * M_PI / Omega);
  }
  else
    m.attach("load", std::make_shared<TimeForce>(course(load, F, tau, trial.end)), {{{x[at], 1.}}});
  const int first = friction ? random.whole(0, n - 1) : n;
  for (int i = first; i < n; ++i)
  {
    mechanism::CoulombFriction::Parameters p;
    p.kinetic_force = F * random.over_decades(0.01, 0.6);
    p.static_force  = p.kinetic_force * random.between(1., 1.4);
    m.attach("f" + std::to_string(i), std::make_shared<mechanism::CoulombFriction>(p), {{{x[i], 1.}}});
  }
  trial.least = 1e-9 * F / stiffest;
  trial.q = trial.v = Vector::Zero(m.size());
  if (load == Load::none)
    for (int i = 0; i < n; ++i)
      trial.v[x[i]] = random.between(-1., 1.) * F / (mass[i] * slowest);
  trial.machine = std::make_shared<Machine>(std::move(m));
  return trial;
}

struct Result
{
  std::string failure;
  long        steps = 0;
  Matrix      q; ///< at 200 instants
};

/// The coordinates at equal distances up to the end.
class Samples : public RunObserver
{
public:
  Samples(const TimeIntegrator &integrator, double end, Matrix &q)
      : integrator_(integrator), end_(end), q_(q), at_(q.rows()), v_(q.rows())
  {
  }

  void step() override
  {
    for (; !complete(); ++next_)
    {
      const double t = end_ * double(next_ + 1) / double(q_.cols());
      if (t > integrator_.time() * (1. + 1e-12))
        return;
      if (t >= integrator_.time())
        at_ = integrator_.instant().q;
      else
        integrator_.interpolate(t, at_, v_);
      q_.col(next_) = at_;
    }
  }
  bool complete() const { return next_ == q_.cols(); }

private:
  const TimeIntegrator &integrator_;
  double                end_;
  Matrix               &q_;
  Vector                at_, v_;
  Eigen::Index          next_ = 0;
};

Result run(Trial &trial, const MethodOptions &method, long most_steps = 100000)
{
  constexpr int samples = 200;
  Result        result;
  try
  {
    Motion                 motion(*trial.machine, make_integrator(*trial.machine, method));
    const IntegrationWork &work = motion.integrator().work();
    result.q.setZero(trial.q.size(), samples);
    Samples observer(motion.integrator(), trial.end, result.q);
    motion.watch(observer);
    motion.begin(0., trial.q, trial.v, {true, trial.end});
    motion.to_end([&] { return work.steps < most_steps; });
    result.steps = work.steps + work.rejected;
    if (!observer.complete())
      result.failure = "more than " + std::to_string(most_steps) + " steps";
  }
  catch (const ConvergenceFailure &failure)
  {
    result.failure = failure.what();
  }
  return result;
}

/// Root mean square, each coordinate against its largest excursion.
double distance(const Matrix &q, const Matrix &truth, double least)
{
  double sum  = 0.;
  int    kept = 0;
  for (Eigen::Index i = 0; i < truth.rows(); ++i)
    if (const double largest = truth.row(i).cwiseAbs().maxCoeff(); largest > least)
    {
      sum += (q.row(i) - truth.row(i)).squaredNorm() / (largest * largest);
      ++kept;
    }
  return kept > 0 ? std::sqrt(sum / double(kept * truth.cols())) : 0.;
}

/// Steps 1/2000 of the run, the linear machine carried exactly.
MethodOptions fixed(const Trial &trial)
{
  return method("exact", trial.end / 2000., 8);
}

struct Kind
{
  const char *name;
  std::string method;
  int         order;
};

class Controlled : public ::testing::TestWithParam<Kind>
{
protected:
  MethodOptions method(double tolerance, const Trial &trial) const
  {
    return controlled(tests::method(GetParam().method, trial.longest_step, GetParam().order), tolerance);
  }
};

TEST_P(Controlled, NeverFailsWhereDryFrictionHoldsAMachineAtRest)
{
  for (const Load load : all_loads)
    for (unsigned seed = 0; seed < 24; ++seed)
    {
      const double tolerance = std::pow(10., -4. - 2. * (seed % 3));
      Trial        trial     = machine(load, seed, true);
      const Result result    = run(trial, method(tolerance, trial));
      EXPECT_EQ(result.failure, "") << int(load) << " " << seed << " " << tolerance;
    }
}

// The local error is controlled; on its way to the end it grows with the number of periods.
TEST_P(Controlled, ErrsInProportionToItsToleranceFromRest)
{
  for (const Load load : {Load::harmonic, Load::pulse, Load::late_pulse, Load::bell})
    for (unsigned seed = 0; seed < 8; ++seed)
    {
      Trial        trial = machine(load, seed, false);
      const Result truth = run(trial, fixed(trial));
      ASSERT_EQ(truth.failure, "") << int(load) << " " << seed;
      for (const double tolerance : {1e-4, 1e-6, 1e-8})
      {
        const Result result = run(trial, method(tolerance, trial));
        ASSERT_EQ(result.failure, "") << int(load) << " " << seed << " " << tolerance;
        EXPECT_LT(distance(result.q, truth.q, trial.least), 40. * tolerance) << int(load) << " " << seed;
      }
    }
}

long steps_of_all(Load load, const std::function<MethodOptions(const Trial &)> &method)
{
  long steps = 0;
  for (unsigned seed = 0; seed < 12; ++seed)
  {
    Trial trial = machine(load, seed, false);
    steps += run(trial, method(trial)).steps;
  }
  return steps;
}

// Of exact propagation nothing is left to control on the way without a law.
TEST(ControlledBdf, TakesNoMoreStepsFromRestThanOnTheWay)
{
  for (const double tolerance : {1e-4, 1e-8})
  {
    const auto own       = [&](const Trial &trial) { return controlled(bdf(5, trial.longest_step), tolerance); };
    const long under_way = steps_of_all(Load::none, own);
    for (const Load load : all_loads)
      EXPECT_LT(steps_of_all(load, own), 2 * under_way) << int(load) << " " << tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Controlled,
                         ::testing::Values(Kind{"bdf", "bdf", 5}, Kind{"exact4", "exact", 4},
                                           Kind{"exact8", "exact", 8}),
                         [](const auto &kind) { return kind.param.name; });

/// Two rotors on a shaft, held at 50 rad/s by a drive with an integral; `disturbance` is a torque on the far one.
Trial driven_shaft(const std::function<double(double)> &disturbance)
{
  Trial        trial;
  MachineModel m;
  const int    near = m.add_rotor("near", {0., 1., 0.}, 0.5, 0., "ground"),
            far     = m.add_rotor("far", {0., 1., 0.}, 2., 0., "ground");
  m.add_linear("shaft", {{near, 1.}, {far, -1.}}, {4e3, 2., 0., 0.}, "N m");
  mechanism::SpeedDrive::Parameters p;
  p.proportional_gain = 40.;
  p.integral_gain     = 300.;
  p.speed             = mechanism::CommandedProfile(50.);
  const auto drive    = std::make_shared<mechanism::SpeedDrive>(p);
  const int  integral = m.add_lag("drive.integral", drive->lag());
  m.attach("drive", drive, {{{near, 1.}}, {{integral, 1.}}});
  m.attach("load", std::make_shared<TimeForce>(disturbance), {{{far, 1.}}});
  trial.q = trial.v = Vector::Zero(m.size());
  trial.v[near] = trial.v[far] = 50.;
  trial.end                    = 2.;
  trial.longest_step           = trial.end / 50.;
  trial.machine                = std::make_shared<Machine>(std::move(m));
  return trial;
}

// The integral has nothing to do until the load comes, and starts like t^3 then.
TEST(DriveAtSpeed, ItsIntegralAsksForNoStepsUntilALoadComes)
{
  const std::function<double(double)> loads[] = {
      [](double) { return 0.; }, [](double t) { return 5. * std::sin(6. * t); },
      [](double t) { return 5. * std::exp(-std::pow((t - 1.) / 0.1, 2)); },
      [](double t) { return t < 0.8 || t > 1.2 ? 0. : 5. * std::pow(std::sin(M_PI * (t - 0.8) / 0.4), 2); }};
  for (const auto &load : loads)
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10})
    {
      Trial        trial  = driven_shaft(load);
      const Result result = run(trial, controlled(bdf(5, trial.longest_step), tolerance));
      EXPECT_EQ(result.failure, "") << tolerance;
      EXPECT_LT(result.steps, 2000. * std::pow(tolerance / 1e-4, -0.25)) << tolerance; // order 5, coarse
    }
}

} // namespace
} // namespace gestell::tests
