// Deflation, and what it finds.

#include "coupling/periodic/deflation.h"
#include "coupling/periodic/minimising.h"
#include "tests/support/periodic_cases.h"
#include "tests/support/reference_table.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Eigen::VectorXd;

std::vector<PeriodicSolution> motions(const std::string &name, int starts)
{
  const DuffingCase &given  = duffing_cases.at(name);
  CubicSystem        system = duffing_system(given);
  PeriodicOptions    options;
  options.own["starts"] = starts;
  return minimising_method().solve(problem_of_period(system, 2. * M_PI / given.Omega),
                                   {VectorXd::Zero(1), VectorXd::Zero(1), 0.}, options);
}

} // namespace

/// M is (1 + 1)(1/4 + 1) at distances of one and two sizes; its slope is that of log M.
TEST(Deflation, IsInfiniteAtWhatIsKnownAndOneFarAway)
{
  Deflation deflation(0.5);
  deflation.add(Eigen::Vector2d(1., 2.));
  deflation.add(Eigen::Vector2d(-0.5, 2.));
  VectorXd slope;
  EXPECT_NEAR(deflation.factor(Eigen::Vector2d(0.5, 2.), slope), 2. * 1.25, 1e-14);
  EXPECT_GT(deflation.factor(Eigen::Vector2d(1., 2.), slope), 1e20);
  EXPECT_NEAR(deflation.factor(Eigen::Vector2d(1e6, 0.), slope), 1., 1e-12);

  const Eigen::Vector2d z(0.2, 1.7);
  VectorXd              none;
  deflation.factor(z, slope);
  for (int i = 0; i < 2; ++i)
  {
    const VectorXd step = 1e-6 * VectorXd::Unit(2, i);
    const double   rise = std::log(deflation.factor(z + step, none) / deflation.factor(z - step, none));
    EXPECT_NEAR(slope[i], rise / 2e-6, 1e-8);
  }
}

/// The unstable motion between the two stable ones has a small basin: 8 free starts miss it.
TEST(Deflation, FindsTheThirdMotionFromFewStarts)
{
  const auto found = motions("duffing1", 8);
  ASSERT_EQ(found.size(), 3u);
  double shares = 0.;
  for (const PeriodicSolution &solution : found)
  {
    EXPECT_EQ(solution.ratio, 1);
    shares += solution.share;
  }
  EXPECT_LE(shares, 1. + 1e-12) << "shares are of the free starts";
}

/// A motion of one period that is found as one of two is told as of one.
TEST(Minimising, TellsTheShortestPeriodOfAMotion)
{
  for (const int starts : {2, 4})
    for (const PeriodicSolution &solution : motions("duffing2", starts))
      EXPECT_EQ(solution.ratio, 1) << starts;
}

/// All motions of the table, from no more than the machine at rest.
TEST(Minimising, FindsTheMotionsOfDuffingsOscillator)
{
  std::map<std::string, std::vector<PeriodicSolution>> found;
  for (const auto &entry : duffing_cases)
    found[entry.first] = motions(entry.first, 24);
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
  {
    double nearest = 1.;
    for (const PeriodicSolution &solution : found.at(row["case"]))
      if (solution.ratio == 1)
        nearest = std::min(nearest, std::hypot(solution.q[0] - row.number("x(0)"), solution.v[0] - row.number("v(0)")));
    EXPECT_LT(nearest, 1e-8) << row["case"] << row["solution"];
  }
}

} // namespace gestell::tests
