// A state that is none is no step, whatever the method: one sum after each tells.

#include "coupling/integration/events/event_driver.h"
#include "coupling/integration/events/finite_state.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/convergence_failure.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// Two masses on springs, the law acts on the second, the load on the first: 10 and 10 sqrt(3) rad/s.
SmallSystem two_masses(SmallSystem::Law law)
{
  const Matrix M = Matrix::Identity(2, 2), C = (Matrix(2, 2) << 200., -100., -100., 200.).finished();
  SmallSystem  system(M, 0.01 * C, C);
  system.set_law(Vector::Unit(2, 1), std::move(law));
  return system;
}

std::vector<MethodOptions> all_methods()
{
  std::vector<MethodOptions> all;
  for (const IntegrationMethod *method : integration_methods())
    for (ChartSetting &setting : method->chart_settings())
    {
      (setting.controlled ? setting.options.tolerance : setting.options.step) = setting.controlled ? 1e-6 : 1e-3;
      if (setting.controlled && !(setting.options.step > 0.))
        setting.options.step = 1e-2;
      all.push_back(setting.options);
    }
  return all;
}

/// Driven until it fails, at latest at t = 1 s; the time of the last state, which is one.
double end_of(SmallSystem system, const MethodOptions &method, const Vector &v)
{
  const auto   integrator = make_integrator(system, method);
  EventOptions events;
  events.end = 1.;
  EventDriver driver(system, *integrator, events);
  driver.begin(0., Vector::Zero(2), v);
  try
  {
    while (integrator->time() < 1.)
      driver.advance();
  }
  catch (const ConvergenceFailure &)
  {
  }
  EXPECT_TRUE(is_finite(integrator->local()));
  return integrator->time();
}

} // namespace

/// Thrown with 0.3 m/s in the mode of 10 rad/s both masses reach 25 mm at asin(5/6)/10 = 98.5 ms, but for damping.
TEST(NoNumber, ALawWithNoneBeyondAnAmplitudeEndsEveryMethodThere)
{
  for (const double value : {none, infinite, -infinite})
    for (const MethodOptions &method : all_methods())
    {
      SCOPED_TRACE(method_name(method));
      const auto   law = law_of([=](double u) { return u < 0.025 ? 0. : value; }, [](double) { return 0.; });
      const double end = end_of(two_masses(law), method, Vector::Constant(2, 0.3));
      EXPECT_LT(end, 0.12);
      EXPECT_GT(end, 0.05);
    }
}

/// And without it none ends.
TEST(NoNumber, ALawWithANumberEverywhereEndsNone)
{
  for (const MethodOptions &method : all_methods())
  {
    SCOPED_TRACE(method_name(method));
    EXPECT_EQ(end_of(two_masses(law_of([](double) { return 0.; }, [](double) { return 0.; })), method,
                     Vector::Constant(2, 0.3)),
              1.);
  }
}

TEST(NoNumber, IsNamedWithItsPlace)
{
  SmallSystem system = two_masses(law_of([](double) { return none; }, [](double) { return 0.; }));
  LocalState  state;
  state.resize(system);
  state.t = 0.25;
  state.u.setZero(), state.v.setZero();
  state.p.setConstant(none);
  EXPECT_NE(non_finite_state_message(system, state).find("t = 0.25 s for the force on q1"), std::string::npos)
      << non_finite_state_message(system, state);
}

} // namespace gestell::tests
