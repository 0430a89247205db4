// Response surfaces: exact where the output is a quadratic, and the statistics of what they leave.

#include "apps/study/designs/response_designs.h"
#include "apps/study/designs/space_filling.h"
#include "apps/study/surface/effects.h"
#include "apps/study/surface/response_surface.h"
#include "tests/support/csv_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::apps;
using gestell::tests::CsvTable;
using gestell::tests::expect_refusal;
using gestell::tests::refusal;

const std::vector<std::string> three = {"a", "b", "c"};

double quadratic(const Eigen::VectorXd &x)
{
  return 3. - 2. * x(0) + 0.5 * x(1) + 4. * x(0) * x(0) - x(2) * x(2) + 1.5 * x(0) * x(1) - 0.25 * x(1) * x(2);
}

template <typename Function>
Eigen::VectorXd computed(const Eigen::MatrixXd &points, Function f)
{
  Eigen::VectorXd y(points.rows());
  for (Eigen::Index run = 0; run < y.size(); ++run)
    y(run) = f(points.row(run).transpose());
  return y;
}

/// Not a polynomial, so that something is left.
double curved(const Eigen::VectorXd &x)
{
  return std::exp(0.7 * x(0)) + std::sin(2. * x(1)) * (1. + x(2));
}

ResponseSurface curved_surface(const Eigen::MatrixXd &points)
{
  return fit_surface(points, computed(points, curved), {"y", "N"}, three);
}

Eigen::MatrixXd without(const Eigen::MatrixXd &rows, Eigen::Index left_out)
{
  Eigen::MatrixXd rest(rows.rows() - 1, rows.cols());
  rest << rows.topRows(left_out), rows.bottomRows(rows.rows() - left_out - 1);
  return rest;
}

struct PressTable
{
  Eigen::MatrixXd coded{24, 4};
  Eigen::VectorXd F_max{24}, abs_F_min{24};
};

PressTable press_table()
{
  const CsvTable                 csv(std::string(GESTELL_SOURCE_DIR) + "/tests/reference/press/doe.csv");
  const std::vector<std::string> columns = {"xi_mass_factor", "xi_c_P_factor", "xi_damping_factor", "xi_s_cl_factor"};
  PressTable                     table;
  for (int run = 0; run < 24; ++run)
  {
    for (int j = 0; j < 4; ++j)
      table.coded(run, j) = csv.number(run, columns[j]);
    table.F_max(run)     = csv.number(run, "F_P_max_N");
    table.abs_F_min(run) = std::abs(csv.number(run, "F_P_min_N"));
  }
  return table;
}

void expect_reference(const ResponseSurface &surface, const std::string &column)
{
  const CsvTable reference(std::string(GESTELL_SOURCE_DIR) + "/tests/reference/press/response_surface.csv");
  const double   scale = reference.number(0, column);
  ASSERT_EQ(surface.terms.size(), 15u);
  for (int j = 0; j < 15; ++j)
  {
    EXPECT_EQ(surface.term_name(j), reference.text(j, "term"));
    // 1e-6 of a coefficient; those that vanish by the design are rounding, 1e-13 of the constant.
    const double b = reference.number(j, column);
    EXPECT_NEAR(surface.coefficients(j), b, 1e-6 * std::abs(b) + 1e-13 * scale) << surface.term_name(j);
  }
  EXPECT_NEAR(surface.quality.r2, reference.number("term", "R2", column), 1e-9);
}

} // namespace

TEST(ResponseSurface, OfThePressMeetsTheReferenceFromItsOwnTable)
{
  const PressTable               table = press_table();
  const std::vector<std::string> names = {"x1", "x2", "x3", "x4"};

  expect_reference(fit_surface(table.coded, table.F_max, {"F_P_max"}, names), "coef_F_P_max_N");
  expect_reference(fit_surface(table.coded, table.abs_F_min, {"F_P_min"}, names), "coef_abs_F_P_min_N");
}

TEST(ResponseSurface, IsExactForAQuadratic)
{
  const Eigen::MatrixXd points  = latin_hypercube(3, 15, 1).points;
  const ResponseSurface surface = fit_surface(points, computed(points, quadratic), {"y"}, three);
  Eigen::VectorXd       exact(10);
  exact << 3., -2., 0.5, 0., 4., 0., -1., 1.5, 0., -0.25;

  EXPECT_LT((surface.coefficients - exact).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_NEAR(surface.quality.r2, 1., 1e-14);
  EXPECT_NEAR(surface.quality.predicted_r2, 1., 1e-13);
  const Eigen::Vector3d outside(1.7, -2., 0.3);
  EXPECT_NEAR(surface.value(outside), quadratic(outside), 1e-12);
}

TEST(ResponseSurface, HasTheGradientOfItsValue)
{
  const ResponseSurface surface = curved_surface(latin_hypercube(3, 20, 1).points);
  const Eigen::Vector3d xi(0.3, -0.7, 0.4);
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d step = 1e-3 * Eigen::Vector3d::Unit(i); // central quotients are exact for quadratics
    EXPECT_NEAR(surface.gradient(xi)(i), (surface.value(xi + step) - surface.value(xi - step)) / 2e-3, 1e-11);
  }
}

TEST(ResponseSurface, HasLeveragesThatSumToTheNumberOfCoefficients)
{
  const ResponseSurface surface = curved_surface(central_composite(3, 1.4, 2).points);

  EXPECT_NEAR(surface.leverage.sum(), 10., 1e-12);
  EXPECT_GE(surface.leverage.minCoeff(), 1. / 16.) << "a model with a constant: h_ii >= 1/n";
  EXPECT_LE(surface.leverage.maxCoeff(), 1. + 1e-12);
}

TEST(ResponseSurface, HasResidualsOrthogonalToEveryTerm)
{
  const Eigen::MatrixXd points  = latin_hypercube(3, 25, 1).points;
  const ResponseSurface surface = curved_surface(points);

  EXPECT_LT(
      (model_matrix(points, surface.terms).transpose() * (surface.computed - surface.fitted)).cwiseAbs().maxCoeff(),
      1e-12);
}

TEST(ResponseSurface, ForetellsEachRunAsTheSurfaceOfTheOthersDoes)
{
  const Eigen::MatrixXd points  = latin_hypercube(3, 14, 1).points;
  const ResponseSurface surface = curved_surface(points);
  double                press   = 0.;
  for (Eigen::Index run = 0; run < points.rows(); ++run)
  {
    const ResponseSurface others = curved_surface(without(points, run));
    const double          said   = others.value(points.row(run).transpose());
    EXPECT_NEAR(surface.left_out(run), said, 1e-11);
    press += std::pow(said - surface.computed(run), 2);
  }
  EXPECT_NEAR(surface.quality.press / press, 1., 1e-10);
}

TEST(ResponseSurface, HoldsTheTruthInItsIntervalsAsOftenAsItSays)
{
  // 400 fits with errors of known distribution: 95 % of 2000 intervals; the share scatters by about 0.005.
  const Eigen::MatrixXd points  = box_behnken(3, 3).points;
  const Eigen::MatrixXd uniform = sobol_points(2 * 15, 400, 9).points;
  int                   inside  = 0;
  for (Eigen::Index trial = 0; trial < 400; ++trial)
  {
    Eigen::VectorXd y = computed(points, quadratic);
    for (Eigen::Index run = 0; run < 15; ++run) // Box & Muller
      y(run) += 0.1 * std::sqrt(-2. * std::log(0.5 * (1. + uniform(trial, 2 * run)))) *
                std::cos(M_PI * uniform(trial, 2 * run + 1));
    const ResponseSurface surface = fit_surface(points, y, {"y"}, three);
    const double          exact[] = {3., -2., 0.5, 0., 4.};
    for (int j = 0; j < 5; ++j)
      inside += std::abs(surface.coefficients(j) - exact[j]) <= surface.confidence(j);
  }
  EXPECT_NEAR(inside / 2000., 0.95, 0.02);
}

TEST(ResponseSurface, PartsItsResidualIntoPureErrorAndLackOfFit)
{
  // y = x on three points, twice each; errors +-1 and a bend of the mean: by hand.
  Eigen::MatrixXd points(6, 1);
  points << -1., -1., 0., 0., 1., 1.;
  Eigen::VectorXd y(6);
  y << -1. + 1., -1. - 1., 3. + 1., 3. - 1., 1. + 1., 1. - 1.;
  const FitQuality q = fit_surface(points, y, {"y"}, {"x"}, {SurfaceOrder::linear, 0.95}).quality;

  EXPECT_NEAR(q.pure_error, 6., 1e-13);
  EXPECT_EQ(q.pure_error_dof, 3);
  EXPECT_NEAR(q.lack_of_fit, 12., 1e-13) << "means -1, 3, 1 about 1 + x: 2 (1 + 4 + 1)";
  EXPECT_EQ(q.lack_of_fit_dof, 1);
  EXPECT_NEAR(q.lack_of_fit_F, 6., 1e-12);
  EXPECT_NEAR(q.lack_of_fit_p_value, 0.0917, 1e-3) << "table of F(1, 3): 5.54 is passed in 10 %, 10.13 in 5 %";
}

TEST(ResponseSurface, OfRunsThatRepeatExactlyBlamesTheFitAlone)
{
  const FitQuality q = curved_surface(central_composite(3, 1.4, 4).points).quality;

  EXPECT_EQ(q.pure_error, 0.);
  EXPECT_EQ(q.pure_error_dof, 3);
  EXPECT_TRUE(std::isinf(q.lack_of_fit_F));
  EXPECT_EQ(q.lack_of_fit_p_value, 0.);
}

TEST(ResponseSurface, OfAsManyRunsAsCoefficientsHasNoStatistics)
{
  const Eigen::MatrixXd points  = latin_hypercube(3, 10, 2).points;
  const ResponseSurface surface = curved_surface(points);

  EXPECT_NEAR(surface.quality.r2, 1., 1e-10);
  EXPECT_TRUE(std::isnan(surface.quality.adjusted_r2));
  EXPECT_TRUE(std::isnan(surface.confidence(0)));
  EXPECT_TRUE(surface.left_out.array().isNaN().all());
}

TEST(ResponseSurface, RefusesFewerRunsThanCoefficients)
{
  expect_refusal([] { curved_surface(latin_hypercube(3, 9, 1).points); }, "9 runs for 10 coefficients");
}

TEST(ResponseSurface, NamesWhatASingularDesignConfounds)
{
  const Eigen::MatrixXd          corners = full_factorial(std::vector<std::vector<double>>(4, {-1., 1.})).points;
  const std::vector<std::string> four    = {"a", "b", "c", "d"};
  const std::string              said =
      refusal([&] { fit_surface(corners, computed(corners, [](const auto &x) { return x(0); }), {"y"}, four); });

  EXPECT_THAT(said, ::testing::HasSubstr("design is singular"));
  EXPECT_THAT(said, ::testing::ContainsRegex("[abcd]\\^2 = "));

  const Eigen::MatrixXd sphere = central_composite(4, 2., 0).points;
  EXPECT_THAT(refusal([&] { fit_surface(sphere, computed(sphere, [](const auto &x) { return x(0); }), {"y"}, four); }),
              ::testing::ContainsRegex("[abcd]\\^2 = 4 - [abcd]\\^2 - [abcd]\\^2 - [abcd]\\^2;"));

  Eigen::MatrixXd tied = latin_hypercube(2, 12, 1).points;
  tied.conservativeResize(12, 3);
  tied.col(2) = 2. * tied.col(1);
  EXPECT_THAT(refusal(
                  [&] {
                    fit_surface(tied, computed(tied, curved), {"y"}, three, {SurfaceOrder::linear, 0.95});
                  }),
              ::testing::ContainsRegex("runs (c = 2 b|b = 0.5 c);"));
}

TEST(ResponseSurface, OfATableLeavesOutRunsThatFailedAndReportsIfTooFewAreLeft)
{
  std::vector<StudyVariable> variables(3);
  for (int i = 0; i < 3; ++i)
    variables[i].name = three[i];
  const Design design = box_behnken(3, 1);
  StudyTable   table  = waiting_table(design, variables, {{"y", "N"}});
  table.values.col(0) = computed(design.points, quadratic);
  for (auto &run : table.runs)
    run.status = RunStatus::done;
  table.runs[2]      = {RunStatus::failed, "no"};
  table.values(2, 0) = std::nan("");

  EXPECT_NEAR(fit_surfaces(table).front().value(Eigen::Vector3d(1., 1., 1.)), quadratic(Eigen::Vector3d(1., 1., 1.)),
              1e-12);
  for (int run = 5; run < 12; ++run)
    table.runs[run].status = RunStatus::waiting;
  expect_refusal([&] { fit_surfaces(table); }, "8 of 13 runs failed or are pending");
  expect_refusal([&] { table.output_index("z"); }, "there are y");
}

// An event that never occurs says nothing of the forces.
TEST(ResponseSurface, OfAnOutputThatNoRunHasIsLeftOutAlone)
{
  std::vector<StudyVariable> variables(3);
  for (int i = 0; i < 3; ++i)
    variables[i].name = three[i];
  const Design design = box_behnken(3, 1);
  StudyTable   table  = waiting_table(design, variables, {{"y", "N"}, {"t", "s"}, {"late", "s"}});
  table.values.col(0) = computed(design.points, quadratic);
  table.values.col(2).tail(12).setOnes(); // the first run is not needed
  for (auto &run : table.runs)
    run.status = RunStatus::done;
  std::vector<std::string> without;
  const auto               surfaces = fit_surfaces(table, {}, &without);
  ASSERT_EQ(surfaces.size(), 3u);
  EXPECT_NEAR(surfaces[0].value(Eigen::Vector3d(1., 1., 1.)), quadratic(Eigen::Vector3d(1., 1., 1.)), 1e-12);
  EXPECT_FALSE(surfaces[1].is_fitted());
  EXPECT_TRUE(std::isnan(surfaces[1].value(Eigen::Vector3d::Zero())));
  EXPECT_EQ(surfaces[2].quality.n_runs, 12);
  ASSERT_EQ(without.size(), 1u);
  EXPECT_THAT(without[0], ::testing::AllOf(::testing::HasSubstr("output t has no surface"),
                                           ::testing::HasSubstr("13 have no value of it")));
  EXPECT_EQ(table.usable_runs().size(), 12u);
}

TEST(Effects, AreTheDifferencesOfMeansOfAFactorialDesign)
{
  const Eigen::MatrixXd points  = full_factorial(std::vector<std::vector<double>>(3, {-1., 1.})).points;
  const Eigen::VectorXd y       = computed(points, curved);
  const auto            effects = effects_of(fit_surface(points, y, {"y"}, three, {SurfaceOrder::interactions, 0.95}));

  ASSERT_EQ(effects.size(), 6u);
  EXPECT_EQ(effects[4].name, "a*c");
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(effects[i].value, points.col(i).dot(y) / 4., 1e-13);
  EXPECT_NEAR(effects[5].value, points.col(1).cwiseProduct(points.col(2)).dot(y) / 4., 1e-13) << effects[5].name;
}

TEST(Effects, HaveTheSharesOfTheVarianceThatManyPointsShow)
{
  const Eigen::MatrixXd points   = latin_hypercube(3, 15, 1).points;
  const auto            effects  = effects_of(fit_surface(points, computed(points, quadratic), {"y"}, three));
  const Eigen::MatrixXd many     = sobol_points(3, 1 << 14).points;
  const Eigen::VectorXd y        = computed(many, quadratic);
  const double          variance = (y.array() - y.mean()).square().mean();

  double sum = 0.;
  for (const Effect &effect : effects)
    sum += effect.share;
  EXPECT_NEAR(sum, 1., 1e-14);
  EXPECT_NEAR(effects[0].share, 4. / 3. / variance, 1e-3) << "b_1 = -2";
  EXPECT_EQ(effects[0].kind, EffectKind::main);
  EXPECT_EQ(effects[3].kind, EffectKind::curvature);
  EXPECT_NEAR(effects[3].value, 4., 1e-12);
}
