// Optima, fronts and scatter of outputs whose answers are known.

#include "apps/study/designs/space_filling.h"
#include "apps/study/optimum/pareto.h"
#include "apps/study/optimum/robust.h"
#include "tests/support/csv_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::apps;
using gestell::tests::CsvTable;
using gestell::tests::expect_refusal;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Outputs (x - a)^2 + 10 (y - b)^2 with a = 0.3, b = -0.4, and x + y; counts how often it is asked.
struct Bowl
{
  int *calls = nullptr;

  OutputPoint operator()(const Eigen::VectorXd &xi, Derivatives derivatives) const
  {
    if (calls)
      ++*calls;
    const double dx = xi(0) - 0.3, dy = xi(1) + 0.4;
    OutputPoint  point;
    point.values = Eigen::Vector2d(dx * dx + 10. * dy * dy, xi(0) + xi(1));
    if (derivatives == Derivatives::wanted)
    {
      point.derivatives.resize(2, 2);
      point.derivatives << 2. * dx, 20. * dy, 1., 1.;
    }
    return point;
  }
};

OptimumTask task_in_box(int k, const std::vector<Goal> &goals, const std::vector<Limit> &limits = {})
{
  return {goals, limits, Eigen::VectorXd::Constant(k, -1.), Eigen::VectorXd::Constant(k, 1.)};
}

const std::vector<SearchMethod> both = {SearchMethod::gradient, SearchMethod::derivative_free};

OptimumOptions by(SearchMethod method)
{
  OptimumOptions options;
  options.method = method;
  return options;
}

/// Surfaces of the press' 24 runs: F_P_max, |F_P_min|, mass.
std::vector<ResponseSurface> press_surfaces()
{
  const CsvTable  csv(std::string(GESTELL_SOURCE_DIR) + "/tests/reference/press/doe.csv");
  Eigen::MatrixXd coded(24, 4), outputs(24, 3);
  for (int run = 0; run < 24; ++run)
  {
    coded.row(run) << csv.number(run, "xi_mass_factor"), csv.number(run, "xi_c_P_factor"),
        csv.number(run, "xi_damping_factor"), csv.number(run, "xi_s_cl_factor");
    outputs.row(run) << csv.number(run, "F_P_max_N"), -csv.number(run, "F_P_min_N"), csv.number(run, "mass_kg");
  }
  std::vector<ResponseSurface> surfaces;
  for (int i = 0; i < 3; ++i)
    surfaces.push_back(fit_surface(coded, outputs.col(i), {"y"}, {"x1", "x2", "x3", "x4"}));
  return surfaces;
}

std::vector<Goal> press_goals()
{
  return {{0, Sense::minimise, 0.4, 1056631.98558},
          {1, Sense::minimise, 0.4, 601646.7616726},
          {2, Sense::minimise, 0.2, 25700.}};
}

} // namespace

TEST(Optimum, OfABowlIsItsBottom)
{
  for (const SearchMethod method : both)
  {
    const Optimum optimum = find_optimum(Bowl(), task_in_box(2, {{0}}), by(method));
    EXPECT_NEAR(optimum.coded(0), 0.3, 1e-5) << method_word(method);
    EXPECT_NEAR(optimum.coded(1), -0.4, 1e-5);
    EXPECT_TRUE(optimum.feasible);
    EXPECT_EQ(optimum.searches.size(), 5u);
  }
}

TEST(Optimum, OnALimitHasGoalAndLimitInParallelGradients)
{
  // x + y >= 0.5: multiplier lambda with 2 dx = 20 dy = lambda and dx + dy = 0.6: dx = 6/11, dy = 0.6/11.
  for (const SearchMethod method : both)
  {
    const Optimum optimum = find_optimum(Bowl(), task_in_box(2, {{0}}, {{1, 0.5}}), by(method));
    EXPECT_NEAR(optimum.coded(0), 0.3 + 6. / 11., 1e-4) << method_word(method);
    EXPECT_NEAR(optimum.coded(1), -0.4 + 0.6 / 11., 1e-4);
    EXPECT_TRUE(optimum.feasible);
  }
}

TEST(Optimum, OfAMaximumLiesInTheCornerOfTheBox)
{
  for (const SearchMethod method : both)
  {
    const Optimum optimum = find_optimum(Bowl(), task_in_box(2, {{1, Sense::maximise}}), by(method));
    EXPECT_NEAR(optimum.values(1), 2., 1e-5) << method_word(method);
    EXPECT_NEAR(optimum.objective, -2., 1e-5);
  }
}

TEST(Optimum, OfThePressIsTheLightVariantOfTheReference)
{
  for (const SearchMethod method : both)
  {
    const Optimum optimum = find_optimum(model_of(press_surfaces()), task_in_box(4, press_goals()), by(method));
    EXPECT_LT((optimum.coded - Eigen::Vector4d(-1., 1., 1., -1.)).cwiseAbs().maxCoeff(), 1e-5) << method_word(method);
  }
}

TEST(Optimum, InACornerTakesFewEvaluationsByGradients)
{
  const Optimum optimum =
      find_optimum(model_of(press_surfaces()), task_in_box(4, press_goals()), by(SearchMethod::gradient));

  for (const SearchTrack &search : optimum.searches)
    EXPECT_LE(search.evaluations, 6) << "a quarter of the design's 24";
  EXPECT_LE(optimum.evaluations, 16)
      << "five starts, the corner, and two points of each search between, as rounding has it";
}

TEST(Optimum, AsksForEachPointOnce)
{
  int           calls   = 0;
  const Optimum optimum = find_optimum(Bowl{&calls}, task_in_box(2, {{0}}, {{1, 0.5}}), by(SearchMethod::gradient));
  int           sum     = 0;
  for (const SearchTrack &search : optimum.searches)
    sum += search.evaluations;

  EXPECT_EQ(calls, optimum.evaluations);
  EXPECT_LE(sum, calls) << "the first start is asked for before the searches";
  EXPECT_GE(sum, calls - 1);
}

TEST(Optimum, OfManyValleysIsTheDeepestThatTheStartsReach)
{
  const auto wave = [](const Eigen::VectorXd &xi, Derivatives)
  {
    OutputPoint point;
    point.values      = Eigen::VectorXd::Constant(1, std::cos(9. * xi(0)) + 0.3 * xi(0));
    point.derivatives = Eigen::MatrixXd::Constant(1, 1, -9. * std::sin(9. * xi(0)) + 0.3);
    return point;
  };
  OptimumOptions options = by(SearchMethod::gradient);
  options.starts         = 12;
  double deepest         = 10.;
  for (int i = 0; i <= 200000; ++i)
    deepest = std::min(deepest, wave(Eigen::VectorXd::Constant(1, -1. + 1e-5 * i), Derivatives::none).values(0));

  EXPECT_NEAR(find_optimum(wave, task_in_box(1, {{0}}), options).objective, deepest, 1e-8);
}

TEST(Optimum, GoesRoundRunsThatFail)
{
  for (const SearchMethod method : both)
  {
    const auto holed = [](const Eigen::VectorXd &xi, Derivatives derivatives)
    {
      OutputPoint point = Bowl()(xi, derivatives);
      if (xi(0) < -0.2)
        point.values.setConstant(not_a_number);
      return point;
    };
    const Optimum optimum = find_optimum(holed, task_in_box(2, {{0}}), by(method));
    EXPECT_NEAR(optimum.coded(0), 0.3, 1e-4) << method_word(method);
    EXPECT_GT(optimum.failed, 0);
  }
}

TEST(Optimum, ThatBreaksALimitSaysSo)
{
  for (const SearchMethod method : both)
  {
    const Optimum optimum = find_optimum(Bowl(), task_in_box(2, {{0}}, {{1, 3.}}), by(method));
    EXPECT_FALSE(optimum.feasible) << method_word(method);
  }
}

TEST(Optimum, RefusesTasksThatMakeNoSense)
{
  const auto find = [](const OptimumTask &task, const OptimumOptions &options = {})
  { return [=] { find_optimum(Bowl(), task, options); }; };
  OptimumOptions none;
  none.starts            = 0;
  const auto no_gradient = [](const Eigen::VectorXd &xi, Derivatives) { return Bowl()(xi, Derivatives::none); };

  expect_refusal(find(task_in_box(2, {})), "no goals");
  expect_refusal(find(task_in_box(2, {{2}})), "output 3 of 2");
  expect_refusal(find(task_in_box(2, {{0, Sense::minimise, -1.}})), "use maximise");
  expect_refusal(find(task_in_box(2, {{0}}, {{1, 2., 1.}})), "is empty");
  expect_refusal(find(task_in_box(2, {{0}}), none), "0 starts");
  expect_refusal([&] { find_optimum(no_gradient, task_in_box(2, {{0}})); }, "derivative-free");
  expect_refusal([] { search_method("gradients"); }, "gradient");
  EXPECT_THROW(find_optimum([](const Eigen::VectorXd &, Derivatives) -> OutputPoint
                            { throw std::runtime_error("no licence"); },
                            task_in_box(2, {{0}})),
               std::runtime_error);
}

TEST(Nondominated, AreThoseThatNoOtherBeats)
{
  Eigen::MatrixXd values(7, 2);
  values << 1., 5., 2., 3., 2., 4., 4., 1., 5., 1., not_a_number, 0., 2., 3.;

  EXPECT_EQ(nondominated(values, {Sense::minimise, Sense::minimise}), (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(nondominated(values, {Sense::maximise, Sense::minimise}), (std::vector<int>{4}));
  EXPECT_EQ(nondominated(values, {Sense::maximise, Sense::maximise}), (std::vector<int>{4, 2, 0}));
}

TEST(Nondominated, LeaveEveryOtherRowBeaten)
{
  const Eigen::MatrixXd  values = sobol_points(3, 300, 4).points;
  const std::vector<int> front  = nondominated(values, std::vector<Sense>(3, Sense::minimise));
  const auto             beats  = [&](int a, int b)
  { return (values.row(a).array() <= values.row(b).array()).all() && values.row(a) != values.row(b); };
  for (int row = 0; row < 300; ++row)
  {
    const bool on_front = std::find(front.begin(), front.end(), row) != front.end();
    const bool beaten   = std::any_of(front.begin(), front.end(), [&](int other) { return beats(other, row); });
    EXPECT_NE(on_front, beaten) << row;
  }
}

TEST(ParetoFront, OfTwoBowlsIsTheLineBetweenTheirBottoms)
{
  const auto two_bowls = [](const Eigen::VectorXd &xi, Derivatives)
  {
    const Eigen::Vector2d a(-0.5, 0.2), b(0.5, 0.2);
    OutputPoint           point;
    point.values = Eigen::Vector2d((xi - a).squaredNorm(), (xi - b).squaredNorm());
    point.derivatives.resize(2, 2);
    point.derivatives << 2. * (xi - a).transpose(), 2. * (xi - b).transpose();
    return point;
  };
  const auto front = pareto_front(two_bowls, task_in_box(2, {{0}, {1}}));

  ASSERT_GE(front.size(), 15u);
  for (const ParetoPoint &point : front) // sqrt(f1) + sqrt(f2) = 1
  {
    EXPECT_NEAR(std::sqrt(point.values(0)) + std::sqrt(point.values(1)), 1., 1e-4);
    EXPECT_NEAR(point.coded(1), 0.2, 1e-2);
  }
  EXPECT_LT(front.front().values(0), 2e-3);
  EXPECT_LT(front.back().values(1), 2e-3);
}

TEST(ParetoFront, HoldsItsConcavePartToo)
{
  // f1^2 + f2^2 = 1 is concave: every weighted sum has an end as its minimum.
  const auto circle = [](const Eigen::VectorXd &xi, Derivatives)
  {
    const double s = 0.25 * M_PI * (xi(0) + 1.), r = 1. + xi(1) + 1.;
    OutputPoint  point;
    point.values = Eigen::Vector2d(r * std::cos(s), r * std::sin(s));
    point.derivatives.resize(2, 2);
    point.derivatives << -0.25 * M_PI * r * std::sin(s), std::cos(s), 0.25 * M_PI * r * std::cos(s), std::sin(s);
    return point;
  };
  const auto front = pareto_front(circle, task_in_box(2, {{0}, {1}}));

  ASSERT_GE(front.size(), 15u);
  for (const ParetoPoint &point : front)
    EXPECT_NEAR(point.values.norm(), 1., 1e-6);
}

TEST(ParetoFront, OfThePressHoldsNoPointTwice)
{
  const auto front = pareto_front(model_of(press_surfaces()), task_in_box(4, press_goals()));

  ASSERT_GT(front.size(), 5u);
  for (std::size_t i = 1; i < front.size(); ++i)
    EXPECT_GT((front[i].values - front[i - 1].values).cwiseQuotient(front[i].values).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ParetoFront, KeepsLimitsAndRefusesASingleGoal)
{
  const auto front = pareto_front(Bowl(), task_in_box(2, {{0}, {1, Sense::maximise}}, {{1, -10., 0.5}}));

  ASSERT_FALSE(front.empty());
  for (const ParetoPoint &point : front)
    EXPECT_LE(point.values(1), 0.5 + 1e-6);
  EXPECT_NEAR(front.back().values(1), 0.5, 1e-3);
  EXPECT_TRUE(pareto_front(Bowl(), task_in_box(2, {{0}, {1}}, {{1, 3., 4.}})).empty());
  expect_refusal([] { pareto_front(Bowl(), task_in_box(2, {{0}})); }, "two goals");
}

namespace
{

std::vector<StudyVariable> scattering(Scatter scatter)
{
  std::vector<StudyVariable> two(2);
  two[0] = {"a", "parameters.a", "m", 1., 3., {}, scatter, 0.1};
  two[1] = {"b", "parameters.b", "N", 0., 20., {}, scatter, 2.};
  return two;
}

/// 2 xi_0 - xi_1.
OutputPoint plane(const Eigen::VectorXd &xi, Derivatives)
{
  OutputPoint point;
  point.values = Eigen::VectorXd::Constant(1, 2. * xi(0) - xi(1));
  return point;
}

} // namespace

TEST(Robust, FiguresOfAPlaneUnderNormalScatterAreThoseOfTheSumOfVariances)
{
  // Coded widths 0.1 and 0.2: standard deviation sqrt(0.2^2 + 0.2^2) = 0.2 sqrt 2; nominal 2 0.5 + 0.25.
  const RobustResult result =
      robust_on(plane, Eigen::Vector2d(0.5, -0.25), scattering(Scatter::normal), {{"y"}}, 20000, 3);
  const RobustFigures &y = result.figures.front();
  const double         s = 0.2 * std::sqrt(2.);

  EXPECT_DOUBLE_EQ(y.nominal, 1.25);
  EXPECT_NEAR(y.mean_error, s / std::sqrt(20000.), 1e-4);
  EXPECT_NEAR(y.deviation_error, s / std::sqrt(40000.), 1e-4) << "of a normal distribution: s / sqrt(2 n)";
  EXPECT_NEAR(y.mean, 1.25, 4. * y.mean_error);
  EXPECT_NEAR(y.deviation, s, 4. * y.deviation_error);
  const Quantile q95 = y.quantiles[3];
  EXPECT_NEAR(0.5 * (q95.low + q95.high), 1.25 + 1.644854 * s, q95.high - q95.low) << "four standard errors";
  // 1.96 sqrt(0.95 0.05 / n) / density, which is 0.1031 / s there.
  EXPECT_NEAR(q95.high - q95.low, 2. * 1.96 * std::sqrt(0.0475 / 20000.) / 0.1031 * s, 0.01 * s);
}

TEST(Robust, QuantilesHoldTheTrueOneAsOftenAsTheySay)
{
  int held = 0;
  for (int seed = 1; seed <= 400; ++seed)
  {
    const RobustResult result =
        robust_on(plane, Eigen::Vector2d::Zero(), scattering(Scatter::normal), {{"y"}}, 200, seed);
    const Quantile q95 = result.figures.front().quantiles[3];
    held += q95.low <= 1.644854 * 0.2 * std::sqrt(2.) && 1.644854 * 0.2 * std::sqrt(2.) <= q95.high;
  }
  EXPECT_NEAR(held / 400., 0.95, 0.04) << "the share scatters by 0.011, and ranks are whole numbers";
}

TEST(Robust, UniformScatterStaysWithinItsWidth)
{
  const Eigen::MatrixXd points = scattered_points(Eigen::Vector2d(0.5, 0.), scattering(Scatter::uniform), 4000, 1);

  EXPECT_LE((points.col(0).array() - 0.5).abs().maxCoeff(), 0.1);
  EXPECT_GT((points.col(1).array()).abs().maxCoeff(), 0.199);
  EXPECT_NEAR(std::sqrt((points.col(1).array() - points.col(1).mean()).square().mean()), 0.2 / std::sqrt(3.), 3e-3);
  EXPECT_EQ(points.topRows(10), scattered_points(Eigen::Vector2d(0.5, 0.), scattering(Scatter::uniform), 10, 1));
}

TEST(Robust, CountsDrawsThatFailBreakLimitsOrLeaveTheRange)
{
  Eigen::MatrixXd values(4, 1);
  values << 1., 2., not_a_number, 4.;
  const RobustResult some = robust_figures(values, {{"y"}}, {{0, 1.5}});

  EXPECT_EQ(some.failed, 1);
  EXPECT_DOUBLE_EQ(some.kept, 0.5);
  EXPECT_DOUBLE_EQ(some.figures.front().mean, 7. / 3.);
  EXPECT_TRUE(std::isinf(some.figures.front().quantiles.back().high)) << "three draws do not tell 99 %";
  EXPECT_NEAR(robust_on(plane, Eigen::Vector2d(1., 0.), scattering(Scatter::normal), {{"y"}}, 4000, 1).outside, 0.5,
              0.03);
}

TEST(Robust, HasFiguresOfTheOutputsThatDrawsHave)
{
  Eigen::MatrixXd values(3, 2);
  values << 1., not_a_number, 2., not_a_number, 3., not_a_number;
  const RobustResult some = robust_figures(values, {{"y"}, {"t"}}, {}, Eigen::Vector2d(2.5, not_a_number));
  ASSERT_EQ(some.figures.size(), 1u);
  EXPECT_EQ(some.failed, 0);
  EXPECT_EQ(some.figures.front().nominal, 2.5);
}

// Searches that know nothing of each other find what they find.
TEST(Optimum, OfSearchesSideBySideIsThatOfOneAfterAnother)
{
  OptimumTask task;
  task.goals                = {{0}};
  task.low                  = Eigen::Vector2d::Constant(-1.);
  task.high                 = Eigen::Vector2d::Constant(1.);
  const OutputModel valleys = [](const Eigen::VectorXd &x, Derivatives)
  {
    OutputPoint point;
    point.values = Eigen::VectorXd::Constant(1, std::cos(7. * x[0]) + std::cos(5. * x[1]) + 0.1 * x.sum());
    return point;
  };
  OptimumOptions options;
  options.method         = SearchMethod::derivative_free;
  options.starts         = 9;
  const Optimum alone    = find_optimum(valleys, task, options);
  options.side_by_side   = 4;
  const Optimum together = find_optimum(valleys, task, options);
  ASSERT_EQ(together.searches.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_LT((together.searches[i].to - alone.searches[i].to).norm(), 1e-6) << i;
  const OutputModel fails = [](const Eigen::VectorXd &, Derivatives) -> OutputPoint
  { throw std::invalid_argument("no such run"); };
  expect_refusal([&] { find_optimum(fails, task, options); }, "no such run");
}

TEST(Robust, RefusesVariablesThatDoNotScatterAndTooFewDraws)
{
  expect_refusal([] { scattered_points(Eigen::Vector2d::Zero(), scattering(Scatter::none), 10, 1); },
                 "no variable scatters");
  expect_refusal([] { scattered_points(Eigen::Vector2d::Zero(), scattering(Scatter::normal), 1, 1); }, "two at least");
  expect_refusal([] { robust_figures(Eigen::MatrixXd::Constant(3, 1, not_a_number), {{"y"}}); }, "0 have results");
}
