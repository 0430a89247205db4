// Work is counted the same way for every method: each look at the forces of the elements is one evaluation.

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/propagation/force_rule.h"
#include "tests/support/methods.h"
#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

MethodOptions of(const std::string &method, int order = 2, ForceRule force = ForceRule::collocation,
                 double tolerance = 0.)
{
  return controlled(tests::method(method, 1e-3, order, {{"force", force_rule_name(force)}}), tolerance);
}

using WorkCount = ::testing::TestWithParam<MethodOptions>;

TEST_P(WorkCount, HoldsEveryLookAtTheForces)
{
  SmallSystem system(Eigen::MatrixXd::Constant(1, 1, 2.), Eigen::MatrixXd::Constant(1, 1, 3.),
                     Eigen::MatrixXd::Constant(1, 1, 500.));
  long        looks = 0;
  system.set_law(Eigen::VectorXd::Ones(1),
                 [&looks](double u, double, double &p, double &dp_du, double &dp_dv)
                 {
                   ++looks;
                   p     = -400. * u * u * u;
                   dp_du = -1200. * u * u;
                   dp_dv = 0.;
                 });
  const auto integrator = make_integrator(system, GetParam());
  integrator->begin(0., Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  for (int k = 0; k < 100; ++k)
    integrator->advance();
  EXPECT_EQ(integrator->work().evaluations, looks);
  EXPECT_GE(integrator->work().evaluations, 100);
  EXPECT_GE(integrator->work().steps, 100);
}

INSTANTIATE_TEST_SUITE_P(Methods, WorkCount,
                         ::testing::Values(of("bdf"), of("bdf", 4), of("bdf", 5, ForceRule::collocation, 1e-6),
                                           of("newmark"), of("hht"), of("generalised-alpha"), of("wilson"),
                                           of("central-difference"), of("exact", 2, ForceRule::average),
                                           of("exact", 2, ForceRule::linear), of("exact", 6),
                                           of("exact", 6, ForceRule::collocation, 1e-6)),
                         [](const auto &info)
                         {
                           std::string name;
                           for (const char c :
                                method_name(info.param) + (info.param.tolerance > 0. ? "controlled" : ""))
                             if (std::isalnum(static_cast<unsigned char>(c)))
                               name += c;
                           return name;
                         });

} // namespace
} // namespace gestell::tests
