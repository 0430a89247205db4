// The work-precision chart: what it concludes from runs, how its references know their own error, and that what it
// offers can be used.

#include "apps/cli/chart/chart_methods.h"
#include "apps/cli/chart/chart_reference.h"
#include "apps/cli/chart/work_measurement.h"
#include "apps/output/charts/work_precision.h"
#include "apps/output/charts/work_precision_chart.h"
#include "apps/output/report/work_precision_page.h"
#include "apps/scene/build/build_machine.h"
#include "tests/support/csv_table.h"
#include "tests/support/methods.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

WorkPoint run(const std::string &method, double step, double error, double cpu_s, bool own = true)
{
  WorkPoint point;
  point.method    = method;
  point.family    = own ? "BDF" : "CVODE";
  point.own       = own;
  point.step      = own ? step : 0.;
  point.tolerance = own ? 0. : step;
  point.error     = error;
  point.cpu_s     = cpu_s;
  point.work      = {100, 0, 120, 1, 120, 130};
  point.settings  = own ? "method    = \"bdf\"\nstep      = 1e-05\n" : "";
  return point;
}

/// Two methods and a peer; A loses to B at fine steps.
WorkPrecision example()
{
  WorkPrecision chart;
  chart.scene       = "example <&>";
  chart.description = "A chart for tests";
  chart.version     = "0";
  chart.peers       = "SUNDIALS 0";
  chart.signals     = {"x"};
  chart.n_samples   = 10;
  chart.end         = 1.;
  chart.models      = {{3, 2, "by hand", 1e-9, 1.}};
  chart.targets     = {1e-2, 1e-3, 1e-5, 1e-9};
  chart.points      = {run("A", 4e-3, 1e-1, 1.),
                       run("A", 2e-3, 1e-2, 2.),
                       run("A", 1e-3, 1e-3, 4.),
                       run("B", 4e-3, 5e-2, 3.),
                       run("B", 2e-3, 1e-4, 6.),
                       run("B", 1e-3, 1e-6, 12.),
                       run("peer", 1e-2, 1e-2, 20., false),
                       run("peer", 1e-4, 1e-4, 80., false)};
  return chart;
}

TEST(ParetoFront, HoldsTheRunsThanWhichNoneIsFasterAndMoreAccurate)
{
  const WorkPrecision chart = example();
  EXPECT_EQ(pareto_front(chart, 0), (std::vector<std::size_t>{0, 1, 2, 4, 5})); // B at 4e-3 loses to A at 2e-3
  for (const std::size_t i : pareto_front(chart, 0))
    for (const WorkPoint &other : chart.points)
      EXPECT_FALSE(other.cpu_s <= chart.points[i].cpu_s && other.error < chart.points[i].error);
}

TEST(ParetoFront, LeavesOutWhatFailedOrIsNotResolved)
{
  WorkPrecision chart      = example();
  chart.points[0].failure  = "diverged";
  chart.points[5].resolved = false;
  chart.points[4].error    = std::nan("");
  EXPECT_EQ(pareto_front(chart, 0), (std::vector<std::size_t>{1, 2})); // what is not resolved beats the finest peer
}

TEST(ParetoFront, BelongsToOneModel)
{
  WorkPrecision chart = example();
  chart.models.push_back(chart.models[0]);
  chart.points[0].model = 1;
  EXPECT_EQ(pareto_front(chart, 1), (std::vector<std::size_t>{0}));
  EXPECT_EQ(pareto_front(chart, 0).front(), 1u);
}

TEST(WorkAtError, LiesOnTheLineOfLogarithmsBetweenTwoRuns)
{
  const WorkPrecision chart  = example();
  const auto          series = work_series(chart);
  // error = 0.1 (cpu)^(-log2(10)): exactly between 1e-2 and 1e-3 the time is sqrt(2 * 4).
  const auto at = work_at_error(chart, series[0], std::sqrt(1e-2 * 1e-3));
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->cpu_s, std::sqrt(8.), 1e-12);
  EXPECT_EQ(at->point, 2u); // the run that is accurate enough
  EXPECT_FALSE(at->bound);
}

TEST(WorkAtError, IsABoundAboveTheCoarsestRunAndNothingBelowTheFinest)
{
  const WorkPrecision chart  = example();
  const auto          series = work_series(chart);
  const auto          coarse = work_at_error(chart, series[0], 0.5);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->cpu_s, 1.);
  EXPECT_TRUE(coarse->bound);
  EXPECT_FALSE(work_at_error(chart, series[0], 1e-4));
}

TEST(WorkAtError, DoesNotTrustARunThatIsAccurateByChance)
{
  WorkPrecision chart   = example();
  chart.points[0].error = 1e-5; // the coarsest, while finer ones have 1e-2
  const auto at         = work_at_error(chart, work_series(chart)[0], 5e-3);
  ASSERT_TRUE(at);
  EXPECT_GT(at->cpu_s, 2.);
  EXPECT_EQ(at->point, 2u);
}

TEST(WorkAtError, GoesPastARunGivenUpForItsTime)
{
  WorkPrecision chart = example();
  chart.points.push_back(run("A", 5e-4, std::nan(""), 20.));
  chart.points.back().failure = "more than 20 s of CPU time";
  EXPECT_TRUE(work_at_error(chart, work_series(chart)[0], 5e-3));
}

TEST(WorkAtError, IsNotToldBelowTenTimesTheErrorOfTheReference)
{
  WorkPrecision chart             = example();
  chart.models[0].reference_error = 2e-4;
  EXPECT_FALSE(work_at_error(chart, work_series(chart)[0], 1.9e-3));
  EXPECT_TRUE(work_at_error(chart, work_series(chart)[0], 2.1e-3));
}

TEST(ChartText, TellsChoicesAndRatios)
{
  const std::string text = work_precision_text(example());
  EXPECT_NE(text.find("fastest at an error of 0.01: A, 2000 us"), std::string::npos) << text;
  EXPECT_NE(text.find("10 times as long"), std::string::npos) << text; // 20 s against 2 s
  EXPECT_NE(text.find("fastest at an error of 1e-05: B, 1000 us"), std::string::npos) << text;
  EXPECT_NE(text.find("no run of SUNDIALS 0 reaches this error"), std::string::npos) << text;
  EXPECT_NE(text.find("fastest at an error of 1e-09: not resolved by the reference"), std::string::npos) << text;
}

TEST(ChartTable, HoldsEveryRunWithItsCounts)
{
  WorkPrecision chart     = example();
  chart.points[0].failure = "went, \"wrong\"";
  Folder         folder("chart_table");
  const CsvTable table(
      folder.file("chart.csv", work_precision_csv(chart)).substr(1, (folder / "chart.csv").string().size()));
  ASSERT_EQ(table.rows(), 8);
  EXPECT_EQ(table.number(4, "error"), 1e-4);
  EXPECT_EQ(table.number(4, "cpu [s]"), 6.);
  EXPECT_EQ(table.number(4, "newton"), 120.);
  EXPECT_EQ(table.text(4, "pareto"), "1");
  EXPECT_EQ(table.text(3, "pareto"), "0");
  EXPECT_EQ(table.text(0, "error"), "");
  EXPECT_EQ(table.number(6, "tolerance"), 1e-2);
}

TEST(ChartPicture, ShowsEveryMethodAndNothingThatIsNotANumber)
{
  WorkPrecision chart   = example();
  chart.points[5].error = std::nan("");
  for (const WorkMeasure measure : {WorkMeasure::cpu, WorkMeasure::evaluations})
  {
    const std::string svg = work_precision_svg(chart, 0, measure);
    for (const char *text : {">A<", ">B<", ">peer<", "example &lt;&amp;&gt;"})
      EXPECT_NE(svg.find(text), std::string::npos) << text;
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
  }
  chart.points.clear(); // nothing succeeded: still a picture
  EXPECT_NE(work_precision_svg(chart, 0, WorkMeasure::cpu).find("</svg>"), std::string::npos);
}

TEST(ChartPage, IsOneFileWithoutANetwork)
{
  WorkPrecision chart    = example();
  chart.points[0].method = "</script><b>";
  const std::string page = work_precision_page(chart);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("</script><b>"), std::string::npos);
  EXPECT_NE(page.find("\"error\": 0.0001"), std::string::npos);
}

TEST(ChartMethods, AreChosenByNameAndByBeginning)
{
  const auto exact = choose_methods({"exact*"}, PeerChoice::with, 10);
  EXPECT_EQ(exact.size(), 10u);
  EXPECT_EQ(choose_methods({"bdf-2", "hht"}, PeerChoice::with, 10).size(), 2u);
  for (const ChartMethod &method : choose_methods({}, PeerChoice::without, 10))
    EXPECT_FALSE(method.peer) << method.key;
  expect_refusal([&] { choose_methods({"bdf2"}, PeerChoice::with, 10); }, "bdf-2");
}

/// A mass of 2 kg on a spring of 800 N/m, 20 rad/s, undamped, let go at 1 mm; a second one, loosely coupled, that runs
/// into a stop if `play`.
std::string tiny_scene(const std::string &run, bool play)
{
  const std::string coupling = play ? "-50" : "0";
  return "name = 'tiny'\n" +
         table("frame",
               {{"mass", "[[2, 0], [0, 1]]"}, {"stiffness", "[[800, " + coupling + "], [" + coupling + ", 900]]"}}) +
         table("frame.interface.a", {{"rows", "{ ux = 1 }"}, {"position", "[0, 0, 0]"}}) +
         table("frame.interface.b", {{"rows", "{ ux = 2 }"}, {"position", "[1, 0, 0]"}}) +
         (play ? element("stop", "clearance",
                         {{"from", "frame.a"},
                          {"to", "frame.b"},
                          {"direction", "[1, 0, 0]"},
                          {"gap", "0.5 mm"},
                          {"stiffness", "1e5 N/m"}})
               : "") +
         start("rule = 'given'\nq = { 'frame.a.ux' = '1 mm' }") + "[run]\n" + run + "end = '0.5 s'\n" +
         "[output.signals]\nx = 'frame.a.ux'\n";
}

struct TinyProblem
{
  explicit TinyProblem(bool play)
      : folder("tiny"), scene(read_scene(path(play))), machine(build_machine(scene)),
        initial(initial_state(scene, machine)), problem{machine, initial}
  {
    problem.signals  = scene_signals(scene, machine);
    problem.repeat_s = 0.;
    for (int k = 1; k <= 100; ++k)
      problem.samples.push_back(0.005 * k);
  }
  std::string path(bool play) const
  {
    folder.file("tiny.toml", tiny_scene("method = \"bdf\"\nstep = \"1 ms\"\n", play));
    return (folder / "tiny.toml").string();
  }

  Folder                 folder;
  Scene                  scene;
  coupling::Machine      machine;
  coupling::InitialState initial;
  WorkProblem            problem;
};

TEST(OwnReference, StatesAnErrorThatIsNotTooSmall)
{
  TinyProblem              tiny(false);
  std::vector<std::string> notes;
  const Reference          reference = own_reference(tiny.problem, notes);
  ASSERT_EQ(reference.values.cols(), 100);
  SignalSamples exact(1, 100);
  for (int k = 0; k < 100; ++k)
    exact(0, k) = 1e-3 * std::cos(20. * tiny.problem.samples[k]);
  // What is stated is the distance between runs; rounding in some hundred steps adds to both.
  EXPECT_LE(scaled_error(reference.values, exact), 2. * reference.error + 1e-13);
  EXPECT_LT(reference.error, 1e-9);
}

TEST(OwnReference, HoldsForAMachineWithEventsToo)
{
  TinyProblem              tiny(true);
  std::vector<std::string> notes;
  const Reference          reference = own_reference(tiny.problem, notes);
  // another method altogether: of second order, so extrapolated from two steps
  const SignalSamples fine   = measure(tiny.problem, method("newmark", 1e-5), true).values;
  const SignalSamples coarse = measure(tiny.problem, method("newmark", 2e-5), true).values;
  ASSERT_GT(fine.size(), 0);
  const double step_error = scaled_error(fine, coarse) / 3.;
  EXPECT_LT(scaled_error(fine, reference.values), 2. * step_error);
  EXPECT_LT(reference.error, 0.01 * step_error);
}

// From 0.25 s on the force is no number: no method gets to the end.
TEST(OwnReference, IsMissingWithAWordWhereNoMethodGetsToTheEnd)
{
  const Folder folder("no_reference");
  folder.file("tiny.toml", tiny_scene("method = \"bdf\"\nstep = \"1 ms\"\n", false) +
                               "[element.f]\ntype = \"formula force\"\nfrom = \"frame.a\"\ndirection = [1, 0, 0]\n"
                               "force = \"1 N * sqrt(1 - 4*t/(1 s))\"\n");
  const Scene                  scene   = read_scene((folder / "tiny.toml").string());
  coupling::Machine            machine = build_machine(scene);
  const coupling::InitialState initial = initial_state(scene, machine);
  WorkProblem                  problem{machine, initial};
  problem.signals = scene_signals(scene, machine);
  problem.samples = {0.1, 0.5};
  std::vector<std::string> notes;
  EXPECT_EQ(own_reference(problem, notes).values.size(), 0);
  ASSERT_GT(notes.size(), 2u); // each that was tried, and what is missing
  EXPECT_NE(notes.back().find("no reference: errors are unknown"), std::string::npos) << notes.back();
}

TEST(Measurement, OfAPeerGivesTheSameSignalsAsOurMethods)
{
  if (!peers::peers_available())
    GTEST_SKIP() << "no SUNDIALS in this build";
  TinyProblem                   tiny(true);
  const coupling::MethodOptions own = method("exact", 2e-4, 6);
  peers::PeerOptions            peer;
  peer.tolerance  = 1e-8;
  peer.events     = true;
  const WorkRun a = measure(tiny.problem, own, true),
                b = measure(tiny.problem, peer, motion_scales(tiny.problem, own, true));
  ASSERT_EQ(a.failure, "");
  ASSERT_EQ(b.failure, "");
  EXPECT_LT(scaled_error(b.values, a.values), 1e-4); // local errors of 1e-8 in some thousand steps
  EXPECT_EQ(a.events, b.events);
  EXPECT_GT(a.events, 2);
}

TEST(ScaledError, IsTheRootMeanSquareRelativeToEachSignal)
{
  SignalSamples reference(3, 2), values(3, 2);
  reference << 4., -2., 0.1, 0.05, 0., 0.;
  values << 4.4, -2., 0.1, 0.06, 7., 7.; // 10 % of the first, 10 % of the second once each; the third is left out
  EXPECT_NEAR(scaled_error(values, reference), std::sqrt(2 * 0.01 / 4.), 1e-15);
  values(0, 0) = std::nan("");
  EXPECT_TRUE(std::isinf(scaled_error(values, reference)));
  EXPECT_TRUE(std::isinf(scaled_error(SignalSamples(), reference)));
}

TEST(ReferenceTable, IsReadAndRefused)
{
  Folder     folder("reference_table");
  const auto path = [&](const std::string &text)
  {
    folder.file("r.csv", text);
    return (folder / "r.csv").string();
  };
  const ReferenceFile good(path("t [s],x [m],F\n0.1,1,2\n0.2,3,4\n"));
  EXPECT_TRUE(good.has("x"));
  EXPECT_FALSE(good.has("t"));
  EXPECT_EQ(good.column("F"), (std::vector<double>{2., 4.}));
  EXPECT_EQ(good.times, (std::vector<double>{0.1, 0.2}));
  for (const char *bad :
       {"", "x,y\n1,2\n3,4\n", "t,x\n1,2\n1,3\n", "t,x\n1,2\n2\n", "t,x\n1,2\n2,two\n", "t,x\n1,2,3\n", "t,x\n"})
    EXPECT_THROW(ReferenceFile(path(bad)), std::invalid_argument) << bad;
}

TEST(ChartSettings, OfEveryMethodAreThoseOfAScene)
{
  Folder folder("chart_settings");
  for (const ChartMethod &method : choose_methods({}, PeerChoice::without, 10))
    for (const bool events : {true, false})
    {
      const double value = method.controlled ? 1e-5 : 2e-4;
      folder.file("s.toml", tiny_scene(scene_settings(method, value, events), true));
      const coupling::RunOptions    run  = read_scene((folder / "s.toml").string()).run.options;
      const coupling::MethodOptions read = run.method;
      EXPECT_EQ(run.events, events);
      EXPECT_EQ(method.controlled ? read.tolerance : read.step, value) << method.key;
      EXPECT_EQ(coupling::method_name(read), coupling::method_name(method.own)) << method.key;
    }
}

TEST(ChartCommand, WritesItsFilesAndSettingsThatRun)
{
  Folder            folder("chart_command");
  const std::string scene = folder.file("tiny.toml", tiny_scene("method = \"bdf\"\nstep = \"1 ms\"\n", true));
  expect_answer(gestell("chart " + scene + folder.option() +
                        "--methods bdf-2,exact-6-controlled,cvode-5 --steps 1e-3,1e-4 --tolerances 1e-4,1e-8 --error "
                        "1e-3 --samples 50"),
                0, {"fastest at an error of 0.001"});
  for (const char *name : {"chart.csv", "chart.html", "chart_settings.toml", "charts/work_precision.svg",
                           "charts/work_precision_counts.svg"})
    EXPECT_GT(read(folder.results() / name).size(), 100u) << name;
  const CsvTable table((folder.results() / "chart.csv").string());
  EXPECT_EQ(table.rows(), peers::peers_available() ? 12 : 8); // methods x (steps or tolerances) x events

  // The settings offered are a piece of a scene.
  std::string text = tiny_scene("", true);
  text.replace(text.find("[run]\n"), 6, read(folder.results() / "chart_settings.toml"));
  const Answer check =
      gestell("run " + folder.file("offered.toml", text) + " --quiet -o '" + (folder / "run").string() + "'");
  EXPECT_EQ(check.exit_code, 0) << check.text << text;
}

TEST(ChartCommand, RefusesWhatItCannotDo)
{
  Folder            folder("chart_refuses");
  const std::string scene   = folder.file("tiny.toml", tiny_scene("method = \"bdf\"\nstep = \"1 ms\"\n", true));
  const auto        refused = [&](const std::string &options, const std::string &says)
  {
    const Answer answer = gestell("chart " + scene + folder.option() + options);
    EXPECT_EQ(answer.exit_code, 2) << options << answer.text;
    EXPECT_TRUE(answer.says(says)) << options << answer.text;
    EXPECT_FALSE(std::filesystem::exists(folder.results())) << options;
  };
  refused("--methods bdf-9", "--methods");
  refused("--modes 10", "--modes");
  refused("--steps ten", "--steps");
  refused("--tolerances -1", "--tolerances");
  refused("--signals y", "--signals");
  refused("--samples 1", "--samples");
  refused("--events sometimes", "--events");
  refused("--reference none.csv", "--reference");
}

} // namespace
} // namespace gestell::tests
