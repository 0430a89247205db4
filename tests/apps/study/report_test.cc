// Pages and tables of studies: what is found stands there, what is not is left out.

#include "apps/study/designs/response_designs.h"
#include "apps/study/designs/space_filling.h"
#include "apps/study/report/contour_picture.h"
#include "apps/study/report/effect_picture.h"
#include "apps/study/report/scatter_matrix.h"
#include "apps/study/report/study_report.h"
#include "apps/study/report/study_tables.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::apps;
using ::testing::HasSubstr;
using ::testing::Not;

double first_output(const Eigen::VectorXd &x)
{
  return 2e5 + 1e4 * x(0) + 5e3 * x(1) * x(1) - 2e3 * x(0) * x(1);
}
double second_output(const Eigen::VectorXd &x)
{
  return 0.2 - 0.05 * x(0) + 0.01 * x(1);
}

/// A study of two variables and two outputs, in which a run has failed.
StudyFindings findings_of(const Design &design)
{
  StudyFindings findings;
  findings.name   = "two <variables>";
  findings.scene  = "press.toml";
  findings.design = design;
  std::vector<StudyVariable> variables(2);
  variables[0]   = {"c_P", "parameters.c_P", "N/m", 8e8, 1e9, {}, Scatter::normal, 1e7};
  variables[1]   = {"s_cl", "parameters.s_cl", "m", 1e-4, 3e-4};
  findings.table = waiting_table(design, variables, {{"F", "N"}, {"x", "m"}});
  for (int run = 0; run < design.n_runs(); ++run)
  {
    const Eigen::VectorXd xi = design.points.row(run).transpose();
    findings.table.values.row(run) << first_output(xi), second_output(xi);
    findings.table.runs[run] = {RunStatus::done, "", "run_" + std::to_string(run + 1) + "/report.html", 0.5};
  }
  findings.table.runs[0] = {RunStatus::failed, "Newton & co. gave up"};
  findings.table.values.row(0).setConstant(std::nan(""));
  return findings;
}

StudyFindings complete_findings()
{
  StudyFindings findings  = findings_of(central_composite(2, 1.4, 3));
  findings.surfaces       = fit_surfaces(findings.table);
  const OutputModel model = model_of(findings.surfaces);
  StudyOptimum      optimum;
  optimum.task        = {{{0}}, {{1, 0.19}}, -Eigen::Vector2d::Ones(), Eigen::Vector2d::Ones()};
  optimum.found       = find_optimum(model, optimum.task);
  findings.optimum    = optimum;
  findings.front_task = {{{0}, {1}}, {}, optimum.task.low, optimum.task.high};
  findings.front      = pareto_front(model, findings.front_task);
  findings.robust     = {
          robust_on(model, Eigen::Vector2d::Zero(), findings.table.variables, findings.table.outputs, 500, 1)};
  return findings;
}

std::size_t count_of(const std::string &text, const std::string &part)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

} // namespace

TEST(StudyReport, OfAllThatAStudyFindsHasEverySectionAndNoReferenceOutsideIt)
{
  const StudyReport report = make_study_report(complete_findings());

  for (const std::string section : {"optimum", "over", "effects", "front", "surfaces", "robust", "scatter", "runs"})
  {
    EXPECT_THAT(report.html, HasSubstr("<section id=\"" + section + "\""));
    EXPECT_THAT(report.html, HasSubstr("<a href=\"#" + section + "\""));
  }
  EXPECT_THAT(report.html, HasSubstr("two &lt;variables&gt;"));
  EXPECT_THAT(report.html, HasSubstr("failed: Newton &amp; co. gave up"));
  EXPECT_THAT(report.html, HasSubstr("<a href=\"run_2/report.html\">2</a>"));
  EXPECT_THAT(report.html, HasSubstr("No run has verified this point."));
  EXPECT_THAT(report.html, Not(HasSubstr("nan")));
  EXPECT_EQ(count_of(report.html, "http"), count_of(report.html, "http://www.w3.org/2000/svg"));
  EXPECT_EQ(report.pictures.size(), 2u + 2u + 1u + 2u * 3u + 1u)
      << "over a variable; effects; front; contour, slices, predicted; scatter";
  EXPECT_LT(report.html.find("class=\"keys\""), report.html.find("<section"));
  EXPECT_THAT(report.html, HasSubstr("F at the optimum"));
}

TEST(StudyReport, LeavesOutWhatWasNotAskedFor)
{
  const StudyReport report = make_study_report(findings_of(latin_hypercube(2, 5, 1)));

  for (const std::string section : {"optimum", "effects", "front", "surfaces", "robust"})
    EXPECT_THAT(report.html, Not(HasSubstr("<section id=\"" + section + "\"")));
  EXPECT_THAT(report.html, HasSubstr("4 done, 1 failed"));
}

TEST(StudyReport, OfManyRunsStaysReadable)
{
  const StudyReport report = make_study_report(findings_of(sobol_points(2, 3000)));

  EXPECT_THAT(report.html, HasSubstr("The first 500 of 3000 runs"));
  EXPECT_LT(report.html.size(), 500000u);
}

TEST(StudyReport, OfAnOutputThatDoesNotChangeSaysSo)
{
  StudyFindings findings = findings_of(central_composite(2, 1.4, 3));
  findings.table.values.col(1).setConstant(0.3);
  findings.surfaces = fit_surfaces(findings.table);

  EXPECT_THAT(make_study_report(findings).html, HasSubstr("x does not change over the runs."));
  for (const Effect &effect : effects_of(findings.surfaces[1]))
    EXPECT_EQ(effect.share, 0.);
}

TEST(EffectPicture, HasABarForEachVariableAndWhatTwoAdd)
{
  const StudyFindings findings = complete_findings();
  const std::string   svg      = effect_picture(findings.surfaces[0], std::nan(""));

  EXPECT_THAT(svg, HasSubstr("Change of F [kN] from 200 kN at the midpoint"));
  EXPECT_THAT(svg, HasSubstr("-10 / +10")) << "c_P";
  EXPECT_THAT(svg, HasSubstr("+5 / +5")) << "s_cl";
  EXPECT_THAT(svg, HasSubstr("±2")) << "c_P × s_cl";
}

TEST(ContourPicture, DrawsLevelsWithTheirValuesAndTheOptimum)
{
  const StudyFindings findings = complete_findings();
  const std::string   svg      = contour_picture(findings.surfaces[0], findings.table.variables,
                                                 findings.table.usable().coded(), {0, 1, Eigen::Vector2d(-1., 0.), true});

  EXPECT_THAT(svg, HasSubstr(">195</text>"));
  EXPECT_THAT(svg, HasSubstr("c_P [MN/m]"));
  EXPECT_THAT(svg, HasSubstr("s_cl [µm]"));
  EXPECT_EQ(count_of(svg, "<title>optimum</title>"), 1u);
  // Of 10 runs that are done four star points lie outside of the range; the first corner failed.
  EXPECT_EQ(count_of(svg, "<circle"), 6u);
}

TEST(ScatterMatrix, HasAnOutlineForEveryPairAndCorrelationsAboveTheDiagonal)
{
  const StudyTable table =
      findings_of(full_factorial(std::vector<std::vector<double>>(2, {-1., 0., 1.}))).table.usable();
  const std::string svg = scatter_matrix(table, {1});

  EXPECT_EQ(count_of(svg, "class=\"grid\""), 16u);
  EXPECT_EQ(count_of(svg, "<circle"), 6u * 8u);
  EXPECT_EQ(count_of(svg, "class=\"f1\""), 6u) << "one run on the front";
}

TEST(StudyTables, HoldTheNumbersExactly)
{
  const StudyFindings findings = complete_findings();
  const std::string   csv      = surface_csv(findings.surfaces);

  EXPECT_THAT(csv, ::testing::StartsWith("output,term,coefficient,confidence\nF,1,"));
  EXPECT_EQ(count_of(csv, "\n"), 1u + 2u * 6u);
  EXPECT_THAT(effects_csv(findings.surfaces),
              ::testing::ContainsRegex("\nF,c_P.s_cl,interaction,-(4000|3999\\.999999999)"));
  EXPECT_EQ(count_of(front_csv(findings), "\n"), 1u + findings.front.size());
  EXPECT_EQ(count_of(robust_csv(findings.robust), "\n"), 3u);
  EXPECT_THAT(surface_quality_csv(findings.surfaces), HasSubstr("\nF [N],10,6,"));
}

TEST(StudyTables, QuoteNamesWithCommas)
{
  StudyFindings findings           = complete_findings();
  findings.surfaces[0].output.name = "peak, \"first\"";

  EXPECT_THAT(surface_csv(findings.surfaces), HasSubstr("\"peak, \"\"first\"\"\",1,"));
}

/// A dimension varied by files has its values on the axis, and a curve for each of the other variable.
TEST(StudyReport, DrawsOutputsOverAVariedDimension)
{
  StudyFindings findings;
  findings.name  = "walls";
  findings.table = waiting_table({"list", Eigen::MatrixXd::Zero(4, 2)}, std::vector<StudyVariable>(2), {{"f", "Hz"}});
  findings.table.variables[0]       = {"wall", "frame.cad", "mm", 15., 20., {15., 20.}};
  findings.table.variables[1].name  = "method";
  findings.table.variables[1].words = {"bdf", "newmark"};
  findings.table.levels << 15., 0., 20., 0., 15., 1., 20., 1.;
  findings.table.values << 30., 34., 31., 35.;
  for (StudyRun &run : findings.table.runs)
    run.status = RunStatus::done;
  const StudyReport report = make_study_report(findings);
  const auto        chart  = std::find_if(report.pictures.begin(), report.pictures.end(),
                                          [](const auto &picture) { return picture.first == "over_f"; });
  ASSERT_NE(chart, report.pictures.end());
  for (const char *part : {"f [Hz] over wall [mm]", "method = bdf", "method = newmark", "run 2: wall = 20 mm"})
    EXPECT_THAT(chart->second, HasSubstr(part));
  EXPECT_THAT(report.html, HasSubstr("<strong>30 to 35 Hz</strong><span>f; minimum at wall = 15 mm, method = bdf"));
}
