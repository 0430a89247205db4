// What a step costs beside arithmetic, and that it is the same step every time.

#include "tests/support/allocation_counter.h"
#include "tests/support/small_system.h"
#include "tests/support/step_map.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Three masses with a hardening, damped spring on one of them and two harmonic loads.
SmallSystem machine()
{
  Matrix M(3, 3), B(3, 3), C(3, 3);
  M << 2., 0.3, 0., 0.3, 1., 0.1, 0., 0.1, 4.;
  B << 6., -1., 0., -1., 4., -2., 0., -2., 3.;
  C << 300., -100., 0., -100., 250., -90., 0., -90., 500.;
  SmallSystem system(M, B, C);
  system.set_law((Vector(3) << 1., -1., 0.).finished(),
                 [](double u, double v, double &p, double &dp_du, double &dp_dv)
                 {
                   p     = -400. * u * u * u - 20. * std::tanh(v / 0.1);
                   dp_du = -1200. * u * u;
                   dp_dv = -200. / std::pow(std::cosh(v / 0.1), 2);
                 });
  system.loads().add_harmonic(0, 3., 90., 10.);
  system.loads().add_harmonic(2, 11., 50., 0.);
  system.loads().add_constant(1, 5.);
  return system;
}

std::unique_ptr<TimeIntegrator> make(const std::string &method, const SecondOrderSystem &system, double h)
{
  const int order = bdf_order(method);
  if (order == 0)
    return one_step_method(method, system, h);
  return std::make_unique<Bdf>(system, Bdf::Options{order, h});
}

using EveryMethod = ::testing::TestWithParam<const char *>;

TEST_P(EveryMethod, TakesNothingFromTheHeapAfterItsStart)
{
  if (!counts_allocations)
    GTEST_SKIP() << "malloc belongs to the sanitizer";
  const SmallSystem system     = machine();
  const auto        integrator = make(GetParam(), system, 1e-3);
  integrator->begin(0., Vector::Zero(3), Vector::Ones(3));
  LocalState between;
  between.resize(1);
  Vector q(3), v(3);
  // One step and the next; BDF has its start besides.
  for (int i = 0; i < 1 + std::max(1, bdf_order(GetParam())); ++i)
    integrator->advance();
  const long before = allocations;
  for (int i = 0; i < 1000; ++i)
  {
    integrator->advance();
    integrator->interpolate(integrator->time() - 4e-4, between);
    integrator->interpolate(integrator->time() - 4e-4, q, v);
    q = integrator->instant().q;
  }
  EXPECT_EQ(allocations - before, 0);
  { // the counter counts
    const Vector taken = Vector::Zero(100);
    EXPECT_GT(allocations, before) << taken.size();
  }
}

TEST_P(EveryMethod, GivesTheSameBitsInEveryRun)
{
  const auto run = [&]
  {
    const SmallSystem system     = machine();
    const auto        integrator = make(GetParam(), system, 1e-3);
    integrator->begin(0., Vector::Zero(3), Vector::Ones(3));
    Vector way(6 * 500);
    for (int i = 0; i < 500; ++i)
    {
      integrator->advance();
      if (i == 300)
      {
        integrator->cut(integrator->time() - 3e-4);
        integrator->restart();
      }
      way.segment(6 * i, 3)     = integrator->instant().q;
      way.segment(6 * i + 3, 3) = integrator->instant().v;
    }
    return way;
  };
  EXPECT_EQ(run(), run());
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         ::testing::Values("bdf1", "bdf2", "bdf3", "bdf4", "bdf5", "bdf6", "newmark_average",
                                           "newmark_linear", "hht_-0.1", "galpha_0.8", "wilson_1.4",
                                           "central_difference"));

} // namespace
} // namespace gestell::tests
