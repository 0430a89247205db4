// [run] of a scene: methods with their parameters, and what is refused.

#include "coupling/integration/integration_methods.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_run.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using test::complaint;
using test::small_scene;

coupling::RunOptions options_of(const std::string &run, const std::vector<std::string> &overrides = {})
{
  return test::scene_of(small_scene("step = \"10 us\"", run), overrides).run.options;
}

double number(const coupling::MethodOptions &options, const std::string &parameter)
{
  return coupling::method_of(options).number(options, parameter);
}

std::string complaint_of(const std::string &run)
{
  return complaint(small_scene("step = \"10 us\"", run));
}

TEST(RunSettings, NameEveryMethodWithItsParameters)
{
  const auto newmark = options_of("method = \"newmark\"\nbeta = 0.3\ngamma = 0.6\nstep = 1e-5").method;
  EXPECT_EQ(newmark.method, "newmark");
  EXPECT_EQ(number(newmark, "beta"), 0.3);
  EXPECT_EQ(number(newmark, "gamma"), 0.6);
  EXPECT_EQ(number(options_of("method = \"wilson\"\ntheta = 1.5\nstep = 1e-5").method, "theta"), 1.5);
  EXPECT_EQ(number(options_of("method = \"hht\"\nalpha = -0.1\nstep = 1e-5").method, "alpha"), -0.1);
  EXPECT_EQ(number(options_of("method = \"generalised-alpha\"\nrho_inf = 0.6\nstep = 1e-5").method, "rho_inf"), 0.6);
  EXPECT_EQ(options_of("method = \"central-difference\"\nstep = 1e-5").method.method, "central-difference");
  const auto exact = options_of("method = \"exact\"\nforce = \"average\"\nstep = 1e-5").method;
  EXPECT_EQ(exact.method, "exact");
  EXPECT_EQ(coupling::method_of(exact).choice(exact, "force"), "average");
  EXPECT_EQ(options_of("method = \"exact\"\norder = 6\nstep = 1e-5").method.order, 6);
}

TEST(RunSettings, HaveTheirDefaults)
{
  const auto fixed = options_of("step = 1e-5");
  EXPECT_EQ(fixed.method.method, "bdf");
  EXPECT_EQ(fixed.method.order, 2);
  EXPECT_TRUE(fixed.events);
  EXPECT_FALSE(fixed.force_unstable);
  EXPECT_EQ(coupling::output_step(fixed), 1e-5);
  const auto controlled = options_of("tolerance = 1e-6");
  EXPECT_EQ(controlled.method.order, 5);
  EXPECT_EQ(controlled.method.step, 0.);
  EXPECT_DOUBLE_EQ(coupling::output_step(controlled), 0.1 / 2000.);
  EXPECT_EQ(options_of("tolerance = 1e-6\nstep = \"1 ms\"").method.step, 1e-3);
  const auto exact = options_of("method = \"exact\"\nstep = 1e-5").method;
  EXPECT_EQ(coupling::method_of(exact).choice(exact, "force"), "collocation");
  EXPECT_EQ(exact.order, 4);
}

TEST(RunSettings, AnotherMethodTakesTheParametersOfTheFormerOneAway)
{
  const test::SceneFolder folder;
  const auto base   = folder.write("base.toml", small_scene("step = \"10 us\"", "order = 3\nstep = \"10 us\""));
  const auto method = [&](const std::vector<std::string> &overrides)
  { return apps::read_scene(base, overrides).run.options.method; };
  EXPECT_EQ(method({}).order, 3);
  EXPECT_EQ(method({"run.method=newmark"}).method, "newmark");
  EXPECT_EQ(method({"run.method=bdf"}).order, 3);
  EXPECT_EQ(method({"run.method=exact"}).order, 4);
  EXPECT_EQ(method({"run.order=6", "run.method=exact"}).order, 6);
  EXPECT_DOUBLE_EQ(method({"run.method=newmark"}).step, 1e-5);
  EXPECT_THROW(method({"run.method=newmark", "run.order=2"}), std::invalid_argument);
  EXPECT_EQ(method({"run.tolerance=1e-6"}).step, 0.);
  EXPECT_EQ(method({"run.tolerance=1e-6"}).order, 5);
  EXPECT_EQ(method({"run.step=1e-3", "run.tolerance=1e-6"}).step, 1e-3);

  const auto child = folder.write("child.toml", "extends = \"base.toml\"\n[run]\nmethod = \"wilson\"\n");
  EXPECT_EQ(apps::read_scene(child).run.options.method.method, "wilson");
}

struct Refused
{
  std::string run, place, words;
};

std::ostream &operator<<(std::ostream &out, const Refused &refused)
{
  return out << refused.run;
}

using RefusedRun = ::testing::TestWithParam<Refused>;

TEST_P(RefusedRun, IsReportedWithLocationAndRemedy)
{
  const std::string text = complaint_of(GetParam().run);
  EXPECT_NE(text.find("scene.toml:"), std::string::npos) << text;
  EXPECT_NE(text.find(GetParam().place), std::string::npos) << text;
  EXPECT_NE(text.find(GetParam().words), std::string::npos) << text;
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedRun,
    ::testing::Values(
        Refused{"order = 3\nmethod = \"newmark\"\nstep = 1e-5", "run.order", "is a key of 'bdf', 'exact'"},
        Refused{"beta = 0.3\nstep = 1e-5", "run.beta", "is a key of 'newmark', but the method is 'bdf'"},
        Refused{"theta = 1.4\nstep = 1e-5", "run.theta", "'wilson'"},
        Refused{"alpha = -0.1\nstep = 1e-5", "run.alpha", "'hht'"},
        Refused{"rho_inf = 0.9\nstep = 1e-5", "run.rho_inf", "'generalised-alpha'"},
        Refused{"force = \"linear\"\nstep = 1e-5", "run.force", "'exact'"},
        Refused{"method = \"wilson\"\ntolerance = 1e-4", "run.tolerance", "is a key of 'bdf', 'exact'"},
        Refused{"tolerance = 1e-14", "run.tolerance", "rounding"},
        Refused{"tolerance = 2", "run.tolerance", "between 0 and 1"},
        Refused{"max_halvings = 3", "run", "or 'tolerance'"}, //
        Refused{"method = \"hht\"", "run", "step"},           //
        Refused{"order = 0\nstep = 1e-5", "run.order", "1 to 6"},
        Refused{"method = \"exact\"\norder = 3\nstep = 1e-5", "run.order", "2, 4, 6 or 8"},
        Refused{"method = \"exact\"\nforce = \"linear\"\norder = 2\nstep = 1e-5", "run.order", "second order"},
        Refused{"method = \"exact\"\nforce = \"linear\"\ntolerance = 1e-4", "run.tolerance", "collocation"},
        Refused{"method = \"newmark\"\nbeta = -0.1\nstep = 1e-5", "run.beta", "zero or positive"},
        Refused{"method = \"wilson\"\ntheta = 0.99\nstep = 1e-5", "run.theta", "1 or more"},
        Refused{"method = \"hht\"\nalpha = 0.1\nstep = 1e-5", "run.alpha", "between -1/3 and 0"},
        Refused{"method = \"hht\"\nalpha = -0.4\nstep = 1e-5", "run.alpha", "between -1/3 and 0"},
        Refused{"method = \"generalised-alpha\"\nrho_inf = -0.1\nstep = 1e-5", "run.rho_inf", "between 0 and 1"},
        Refused{"method = \"generalised-alpha\"\nrho_inf = 1.2\nstep = 1e-5", "run.rho_inf", "between 0 and 1"},
        Refused{"step = 1e-10", "run", "GB of history"}));

TEST(RunSettings, AStepOfHalfTheLoadsPeriodIsReportedByCheck)
{
  const std::string shaker = "[element.shaker]\ntype = \"force\"\nfrom = \"slide\"\n"
                             "harmonics = [{ amplitude = \"1 kN\", frequency = \"400 Hz\" }]\n[start]";
  std::string       text   = small_scene("[start]", shaker);
  EXPECT_EQ(complaint(text, {"run.step=\"1.2 ms\""}), "");
  const std::string reported = complaint(text, {"run.step=\"1.3 ms\""});
  EXPECT_NE(reported.find("400 Hz"), std::string::npos) << reported;
}

coupling::MethodOptions overridden(const std::string &run, const std::vector<std::string> &overrides)
{
  return options_of(run, overrides).method;
}

// The tolerance and its largest step belong to the method that controls its step.
TEST(RunSettings, AToleranceGoesWithTheMethodThatCanHoldIt)
{
  const std::string controlled = "method = \"exact\"\ntolerance = 1e-6\nstep = \"1 ms\"";
  for (const std::string method : {"newmark", "wilson", "hht", "generalised-alpha", "central-difference"})
  {
    const auto o = overridden(controlled, {"run.method=" + method, "run.step=20 us"});
    EXPECT_EQ(o.tolerance, 0.) << method;
    EXPECT_DOUBLE_EQ(o.step, 2e-5) << method;
    EXPECT_DOUBLE_EQ(overridden(controlled, {"run.step=20 us", "run.method=" + method}).step, 2e-5) << method;
    expect_refusal([&] { overridden(controlled, {"run.method=" + method}); }, "needs 'step'");
  }
  const auto bdf = overridden(controlled, {"run.method=bdf"});
  EXPECT_EQ(bdf.tolerance, 1e-6);
  EXPECT_DOUBLE_EQ(bdf.step, 1e-3);
  EXPECT_DOUBLE_EQ(overridden("method = \"bdf\"\nstep = \"30 us\"", {"run.method=newmark"}).step, 3e-5);
}

} // namespace
} // namespace gestell::tests
