// A law that has no number somewhere ends a run there, whatever integrates it: a sum of the state after every step of
// every method tells, and a sum of the signals at every sample.

#include "apps/session/session.h"
#include "coupling/integration/integration_methods.h"
#include "coupling/simulation/simulation.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// All settings of all methods, at a step and a tolerance that suit the scenes below.
std::vector<coupling::MethodOptions> all_methods()
{
  std::vector<coupling::MethodOptions> all;
  for (const coupling::IntegrationMethod *method : coupling::integration_methods())
    for (coupling::ChartSetting &setting : method->chart_settings())
    {
      if (setting.controlled)
        setting.options.tolerance = 1e-6;
      else
        setting.options.step = 1e-3;
      all.push_back(setting.options);
    }
  return all;
}

/// 1 kg on a spring of 100 N/m (10 rad/s), pushed by the law.
std::string slide(const std::string &force)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "100"}}) +
         element("law", "formula force", {{"from", "slide"}, {"force", force}}) +
         signals("x = 'slide.displacement', F = 'law.force'") + steps("1 ms", "0.2 s");
}

/// The top of three masses on springs, pushed by the law.
std::string chain(const std::string &force)
{
  return mass_chain() +
         element("law", "formula force", {{"from", "frame.top"}, {"direction", "[0, 0, 1]"}, {"force", force}}) +
         signals("x = 'frame.top.uz', F = 'law.force'") + steps("1 ms", "0.2 s");
}

bool all_finite(const std::vector<double> &values)
{
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

void expect_end_before(double t, const std::string &text)
{
  const test::SceneFolder folder;
  const apps::Scene       scene = apps::read_scene(folder.write("scene.toml", text), {});
  for (const coupling::MethodOptions &method : all_methods())
    for (const bool energy : {true, false})
    {
      SCOPED_TRACE(coupling::method_name(method) + (energy ? "" : ", without its energy"));
      coupling::RunOptions options = scene.run.options;
      options.method               = method;
      options.energy               = energy;
      options.force_unstable       = true;
      coupling::Machine machine    = apps::build_machine(scene);
      const auto        found      = apps::scene_signals(scene, machine);
      const auto        run        = coupling::simulate(machine, apps::initial_state(scene, machine), options, found);
      EXPECT_NE(run.failure, "");
      if (!coupling::method_of(method).carries_base()) // others know it by the coordinate it acts on alone
      {
        EXPECT_THAT(run.failure, ::testing::HasSubstr("the force law of \"law\" has "));
      }
      EXPECT_THAT(run.failure, ::testing::Not(::testing::HasSubstr("stick")));
      EXPECT_TRUE(all_finite(run.rows));
      ASSERT_GE(run.rows.size(), run.columns.size()); // a first long step may fail
      const double last = run.rows[run.rows.size() - run.columns.size()];
      EXPECT_LE(last, t + 1e-4); // errors of phase at steps of 1 ms
      for (const coupling::SignalSummary &signal : run.signals)
        EXPECT_TRUE(all_finite({signal.min, signal.t_min, signal.max, signal.t_max, signal.final})) << signal.name;
    }
}

// Roots of what is negative.
TEST(NoNumber, ALawWithNoneFromATimeOnEndsEveryRunThere)
{
  expect_end_before(0.05, slide("1 N*sqrt(1 - t/(50 ms))"));
  expect_end_before(0.05, chain("1 kN*sqrt(1 - t/(50 ms))"));
}

/// Behind an event, in the branch that it chooses.
TEST(NoNumber, ALawWithNoneAfterAnEventEndsEveryRunThere)
{
  expect_end_before(0.05, slide("if(t < 50 ms, 1 N, 1 N*log(-1 - t/s))"));
}

/// At rest 3 N bend the spring by 30 mm, in a vibration twice that: 10 mm are reached when cos(10 t) = 2/3.
TEST(NoNumber, ALawWithNoneBeyondAnAmplitudeEndsEveryRunThere)
{
  expect_end_before(0.1 * std::acos(2. / 3.), slide("3 N + 1e-9 N*sqrt(1 - u/(10 mm))"));
  expect_end_before(0.2, chain("30 kN + 1e-9 N*sqrt(1 - u/(2 mm))"));
}

/// What `check` and `run` say of a law that has none at the start.
TEST(NoNumber, AtTheStartACheckAndARunTellTheElementWithItsArguments)
{
  for (const auto &[force, words] : {std::pair("1 N m/u", "no finite value at t = 0, u = 0"),
                                     {"1 N*log(t/s)", "no finite value at t = 0, u = 0"},
                                     {"1 N*sqrt(-1 - u/m)", "no finite value at t = 0, u = 0"},
                                     {"1 N*sqrt(u/m)", "an infinite slope at t = 0, u = 0"}})
  {
    const test::SceneFolder folder;
    const auto              path  = folder.write("scene.toml", slide(force));
    const apps::Scene       scene = apps::read_scene(path, {});
    const auto              told = ::testing::AllOf(::testing::HasSubstr("element.law: "), ::testing::HasSubstr(words));
    EXPECT_THAT(refusal([&] { apps::check_start(scene); }), told);
    EXPECT_THAT(refusal([&] { apps::Session(path).run(); }), told);
  }
}

/// m x'' = a sqrt(t) without the spring: the derivative to the time is infinite at the start, no slope of the law is.
TEST(NoNumber, ARootOfTheTimeHasOneAtTheStart)
{
  const test::SceneFolder folder;
  const apps::Scene       scene   = apps::read_scene(folder.write("scene.toml", slide("1 N*sqrt(t/s)")), {});
  coupling::Machine       machine = apps::build_machine(scene);
  const auto              run     = coupling::simulate(machine, apps::initial_state(scene, machine), scene.run.options,
                                                       apps::scene_signals(scene, machine));
  EXPECT_EQ(run.failure, "");
  EXPECT_NEAR(run.signals[1].final, std::sqrt(0.2), 1e-12);
}

} // namespace
} // namespace gestell::tests
