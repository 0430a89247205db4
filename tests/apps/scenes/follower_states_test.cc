// Machines under loads that follow them: where they rest, which steps stand them.

#include "apps/scene/build/build_machine.h"
#include "coupling/equilibrium/static_balance.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "tests/support/follower_plate.h"
#include "tests/support/scene_motion.h"

#include <Eigen/LU>

#include <algorithm>

namespace gestell::tests
{
namespace
{

/// Two links of 1 m with the masses 2 kg and 1 kg at their ends on springs of 100 N m/rad, as described upright, under
/// a load at the tip along `direction`, which turns with the upper link or not.
std::string column(const std::string &direction, double P, bool follows)
{
  const auto hinge = [](const std::string &name, const std::string &from, const std::string &to, double z)
  {
    Keys spring = {{"from", to}, {"about", "[0, 1, 0]"}, {"stiffness", "100"}};
    if (from != "ground")
      spring.push_back({"to", from});
    return revolute(name, from, to, vector(0., 0., z)) + element("k" + name, "spring-damper", spring);
  };
  Keys load = {{"from", "b2"}, {"at_from", "[0, 0, 2]"}, {"direction", direction}, {"constant", number(P)}};
  if (follows)
    load.push_back({"carried_by", "b2"});
  return planar_body("b1", "2", "1e-6", "[0, 0, 1]") + planar_body("b2", "1", "1e-6", "[0, 0, 2]") +
         hinge("j1", "ground", "b1", 0.) + hinge("j2", "b1", "b2", 1.) + element("P", "force", load);
}

const std::string rest = start("rule = 'static'") + steps("0.1 ms", "1 ms") + signals("a = 'b1.angle', b = 'b2.angle'");

/// All notes and warnings of a run.
std::string said(const SceneRun &motion)
{
  std::string all;
  for (const std::string &warning : coupling::texts_of(motion.result.findings))
    all += warning + '\n';
  return all;
}

// A load across the upper link bends the upper hinge by P l/k, the lower one by what both levers make of it.
TEST(FollowerStates, ALoadAcrossAColumnBendsItAsInTheClosedForm)
{
  for (const double P : {10., 40., 80.})
  {
    const auto   motion = run(column("[1, 0, 0]", P, true) + rest);
    const double bent = P / 100., lower = bent * (1. + std::cos(bent));
    EXPECT_NEAR(motion.at(0, 1), lower, 1e-11) << P;
    EXPECT_NEAR(motion.at(0, 2), lower + bent, 1e-11) << P;
  }
}

// Newton's method has the whole tangent: every correction is the square of the one before, but for a factor.
TEST(FollowerStates, OfRestAreFoundWithQuadraticConvergence)
{
  const apps::Scene            scene   = test::scene_of(column("[1, 0, 0]", 40., true) + rest);
  coupling::Machine            machine = apps::build_machine(scene);
  const Eigen::VectorXd        zero    = Eigen::VectorXd::Zero(machine.size());
  const coupling::InitialState start{0., zero, zero};
  coupling::StaticBalance      balance(machine, start, nullptr);
  Eigen::VectorXd              q = zero, lambda = balance.multipliers(zero, 1.), residual;
  Eigen::MatrixXd              saddle;
  std::vector<double>          corrections;
  while (corrections.size() < 12 && (corrections.empty() || corrections.back() > 1e-9))
  {
    balance.evaluate(q, lambda, 1., saddle, residual);
    const Eigen::VectorXd delta = saddle.fullPivLu().solve(-residual);
    q += delta.head(q.size());
    lambda += delta.tail(lambda.size());
    corrections.push_back(delta.head(q.size()).norm());
  }
  ASSERT_LT(corrections.size(), 12u);
  int squares = 0;
  for (std::size_t k = 1; k < corrections.size(); ++k)
    if (const double before = corrections[k - 1]; before < 0.1 && before > 1e-5) // beyond it rounding is the rest
    {
      EXPECT_LT(corrections[k], 10. * before * before) << k;
      ++squares;
    }
  EXPECT_GT(squares, 0);
}

// Ziegler's column falls under a weight from 0.382 k/l on; under a load that follows it, it stands up to 2.086 k/l, and
// then flutters: nothing to which it could fall.
TEST(FollowerStates, StandWhereAWeightWouldFallAndFlutterBeyond)
{
  const auto standing = [](double P, bool follows)
  {
    const auto motion = run(column("[0, 0, -1]", P, follows) + rest);
    EXPECT_NEAR(motion.at(0, 1), 0., 1e-12);
    EXPECT_NEAR(motion.at(0, 2), 0., 1e-12);
    return said(motion);
  };
  EXPECT_THAT(standing(100., false), ::testing::HasSubstr("unstable equilibrium"));
  EXPECT_THAT(standing(100., true), ::testing::Not(::testing::HasSubstr("equilibrium")));
  EXPECT_THAT(standing(205., true), ::testing::Not(::testing::HasSubstr("equilibrium")));
  const std::string flutter = standing(230., true);
  EXPECT_THAT(flutter, ::testing::HasSubstr("flutter"));
  EXPECT_THAT(flutter, ::testing::HasSubstr("exp(2.31 t/s)"));
}

TEST(FollowerStates, AMachineThatIsUnconstrainedIsNotRelievedOfAThrust)
{
  const std::string flies = planar_body("p", "2", "0.3", "[0, 0, 0]") +
                            element("P", "force",
                                    {{"from", "p"},
                                     {"at_from", "[0, 0, 0.1]"},
                                     {"direction", "[1, 0, 0]"},
                                     {"carried_by", "p"},
                                     {"constant", "3"}}) +
                            start("rule = 'static'\ninertia_relief = true") + steps("1 ms", "2 ms") +
                            signals("a = 'p.angle'");
  expect_refusal([&] { run(flies); }, "follower forces");
}

/// The guard of a method over the plate at rest.
struct Guard
{
  Guard(double P, const coupling::MethodOptions &method)
      : machine(apps::build_machine(test::scene_of(follower_plate(P, 0.)))),
        spectrum(linear_spectrum(machine,
                                 {0., Eigen::VectorXd::Zero(machine.size()), Eigen::VectorXd::Zero(machine.size())})),
        guard(spectrum, method)
  {
  }
  bool refuses() const
  {
    return refusal([&] { guard.check(); }).find("unstable") != std::string::npos;
  }

  coupling::Machine        machine;
  coupling::LinearSpectrum spectrum;
  coupling::StabilityGuard guard;
};

// Without dampers every mode steps by itself: 2/omega is the limit of central differences, of the highest frequency.
TEST(FollowerStates, LimitTheStepByTheFrequenciesTheyHave)
{
  const auto s       = plate_roots(-200., 0.);
  double     highest = 0.;
  for (const auto &own : s)
    highest = std::max(highest, std::abs(own));
  for (const std::string name : {"central-difference", "wilson", "newmark"})
  {
    coupling::MethodOptions method = coupling::options_of(name);
    if (name == "wilson")
      method.set("theta", 1.);
    if (name == "newmark")
      method.set("beta", 1. / 6.), method.set("gamma", 0.5);
    const double limit = (name == "central-difference" ? 2. : std::sqrt(12.)) / highest; // linear acceleration
    method.step        = 0.99 * limit;
    EXPECT_FALSE(Guard(-200., method).refuses()) << name;
    method.step = 1.01 * limit;
    const Guard beyond(-200., method);
    EXPECT_TRUE(beyond.refuses()) << name;
    const double reported = beyond.guard.largest_stable_step(); // three digits, rounded down
    EXPECT_LE(reported, limit) << name;
    EXPECT_GT(reported, 0.99 * limit) << name;
  }
}

// What grows by itself is no fault of the method.
TEST(FollowerStates, ThatFlutterAreNotTheFaultOfTheStep)
{
  coupling::MethodOptions method = coupling::options_of("central-difference");
  method.step                    = 1e-3;
  EXPECT_FALSE(Guard(-400., method).refuses());
  method.step = 0.1;
  EXPECT_TRUE(Guard(-400., method).refuses());
}

} // namespace
} // namespace gestell::tests
