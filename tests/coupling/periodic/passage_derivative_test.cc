#include "coupling/periodic/continuation.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/shooting/shooting_method.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/play_system.h"
#include "tests/support/reference_table.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// BDF has no tangents of its own.
PeriodicOptions by_bdf(double step)
{
  PeriodicOptions options;
  options.integration      = options_of("bdf");
  options.integration.step = step;
  return options;
}

PeriodicSolution shot(const PeriodicProblem &problem, const PeriodicOptions &options, PeriodicGuess guess = {})
{
  if (guess.q.size() == 0)
    guess.q = guess.v = VectorXd::Zero(problem.turn.size());
  const auto found = shooting_method().solve(problem, guess, options);
  EXPECT_EQ(found.size(), 1u);
  return found.at(0);
}

/// two_dof_system("two_dof1"), its first mass in two parts that an ideal joint holds together.
class JoinedSystem final : public CubicSystem
{
public:
  explicit JoinedSystem(double Omega)
      : CubicSystem(masses(), at_first_part(two_dof_system("two_dof1", Omega).B),
                    at_first_part(two_dof_system("two_dof1", Omega).C),
                    {{1., Eigen::Vector3d(1., 0., 0.)}, {0.0042, Eigen::Vector3d(1., 0., -1.)}})
  {
    MatrixXd directions(3, 4);
    directions << MatrixXd(W), VectorXd::Unit(3, 0), VectorXd::Unit(3, 1);
    W = directions.sparseView();
    loads().add_harmonic(0, Omega, 0.11, 0.);
  }
  const IdealJoints &joints() const override { return joint_; }

private:
  struct Joint final : IdealJoints
  {
    std::vector<ConstraintBlock>        all{{0, 1, 2, 2, 1.}};
    const std::vector<ConstraintBlock> &blocks() const override { return all; }
    void constraints(const LocalState &state, VectorXd &g, ConstraintJacobian &G) const override
    {
      g[0] = state.u[2] - state.u[3];
      G[0] << 1., -1.;
    }
    void rates(const LocalState &, VectorXd &rate, VectorXd &bias) const override
    {
      rate.setZero();
      bias.setZero();
    }
  };
  static MatrixXd masses() { return Eigen::Vector3d(0.7, 0.3, 0.05).asDiagonal(); }
  static MatrixXd at_first_part(const MatrixXd &two)
  {
    MatrixXd               three  = MatrixXd::Zero(3, 3);
    const std::vector<int> places = {0, 2};
    three(places, places)         = two;
    return three;
  }
  Joint joint_;
};

double farthest(const Eigen::VectorXcd &mu, const Eigen::VectorXcd &from)
{
  double distance = 0.;
  for (const auto &one : mu)
    distance = std::max(distance, (from.array() - one).abs().minCoeff());
  return distance;
}

} // namespace

/// To the error of BDF's steps.
TEST(PassageDerivative, GivesTheMultipliersOfTheTable)
{
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
  {
    SCOPED_TRACE(row["case"] + ", " + row["solution"]);
    const DuffingCase &given   = duffing_cases.at(row["case"]);
    CubicSystem        system  = duffing_system(given);
    const auto         problem = problem_of_period(system, 2. * M_PI / given.Omega);
    PeriodicOptions    options = by_bdf(problem.period / 4000.);
    options.own["lead-in"]     = 0;
    const VectorXd q = VectorXd::Constant(1, row.number("x(0)")), v = VectorXd::Constant(1, row.number("v(0)"));
    const auto     found = shot(problem, options, {q, v, 0.});
    const std::complex<double> mu(row.number("mu1_re"), row.number("mu1_im"));
    EXPECT_NEAR(found.q[0], q[0], 1e-4 * (1. + std::abs(q[0])));
    EXPECT_LT((found.multipliers.array() - mu).abs().minCoeff(), 1e-3 * (1. + std::abs(mu)));
    EXPECT_EQ(found.stable(), row["stability"] == "stable");
  }
}

/// Across located events they include the saltation.
TEST(PassageDerivative, PassesEvents)
{
  const ClearanceCase &given = clearance_cases.at("clearance1");
  PlaySystem           system(clearance_system(given));
  const auto           problem = problem_of_period(system, 2. * M_PI / given.Omega);
  const auto           exact   = shot(problem, {});
  ASSERT_FALSE(exact.events.empty());
  const auto by_steps = shot(problem, by_bdf(problem.period / 4000.));
  EXPECT_EQ(by_steps.events.size(), exact.events.size());
  EXPECT_LT(farthest(exact.multipliers, by_steps.multipliers), 2e-3);
}

/// Multipliers converge with the square of the step to those of exact tangents.
TEST(PassageDerivative, IsOfSecondOrder)
{
  const DuffingCase &given   = duffing_cases.begin()->second;
  CubicSystem        system  = duffing_system(given);
  const auto         problem = problem_of_period(system, 2. * M_PI / given.Omega);
  const auto         exact   = shot(problem, {}).multipliers;
  double             error[2];
  for (const int k : {0, 1})
    error[k] = farthest(exact, shot(problem, by_bdf(problem.period / (500. * (1 + k)))).multipliers);
  EXPECT_GT(error[1], 0.);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2., 0.2);
}

/// Two parts that a joint holds together move as one, with the same multipliers.
TEST(PassageDerivative, StaysOnIdealJoints)
{
  constexpr double Omega = 1.1;
  JoinedSystem     joined(Omega);
  CubicSystem      whole        = two_dof_system("two_dof1", Omega);
  const auto       problem      = problem_of_period(whole, 2. * M_PI / Omega),
             with_joint         = problem_of_period(joined, 2. * M_PI / Omega);
  const PeriodicOptions options = by_bdf(problem.period / 1000.);
  const auto            one = shot(problem, options), two = shot(with_joint, options);
  EXPECT_LT(two.residual, 1e-9);
  EXPECT_NEAR(two.q[0], one.q[0], 1e-8);
  EXPECT_NEAR(two.q[1], one.q[0], 1e-8);
  EXPECT_NEAR(two.v[2], one.v[1], 1e-8);
  EXPECT_LT(farthest(one.multipliers, two.multipliers), 1e-3);
}

/// Through folds, past unstable motions: those of the whole mass at the same parameter, by the same steps.
TEST(PassageDerivative, FollowsABranch)
{
  const ProblemFamily family = [](double Omega)
  {
    FamilyMember member;
    auto         system = std::make_shared<JoinedSystem>(Omega);
    member.problem      = problem_of_period(*system, 2. * M_PI / Omega);
    member.owner        = system;
    return member;
  };
  const FamilyMember    first     = family(0.9);
  const PeriodicOptions options   = by_bdf(2. * M_PI / 500.);
  const auto            begin     = shot(first.problem, options);
  const auto            equations = branch_from(begin, family, options, 1);
  ContinuationOptions   along     = branch_options(0.9, 1.3, 40);
  along.tolerance                 = 1e-8;
  const Branch branch             = follow_branch(*equations, begin, along, {});
  ASSERT_FALSE(branch.failed) << branch.ended;
  int stable = 0;
  for (const BranchPoint &point : branch.points)
  {
    CubicSystem     whole   = two_dof_system("two_dof1", point.parameter);
    const auto      problem = problem_of_period(whole, 2. * M_PI / point.parameter);
    PeriodicOptions here    = options;
    here.own["lead-in"]     = 0;
    PeriodicGuess near;
    near.q           = point.solution.q(std::vector<int>{0, 2});
    near.v           = point.solution.v(std::vector<int>{0, 2});
    const auto found = shot(problem, here, near);
    SCOPED_TRACE(point.parameter);
    EXPECT_NEAR(found.q[0], near.q[0], 1e-5 * found.q.norm()); // 1e-8 of the speed, amplified near folds
    EXPECT_NEAR(found.largest_multiplier(), point.solution.largest_multiplier(), 5e-3);
    stable += point.solution.stable();
  }
  EXPECT_GT(stable, 0);
  EXPECT_LT(stable, int(branch.points.size()));
}

} // namespace gestell::tests
