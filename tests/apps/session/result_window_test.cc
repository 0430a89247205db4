// [output] from: extremes, spectra and derivatives of a window of the run, the history as it was.

#include "apps/analysis/analyses.h"
#include "apps/analysis/comparison/scene_comparison.h"
#include "apps/analysis/spectra/spectrum_values.h"
#include "apps/output/tables/result_tables.h"
#include "apps/session/session.h"
#include "tests/apps/session/differentiated.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Result;
using apps::Session;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// x = x_0 exp(-delta t) cos(omega t) but for terms of delta/omega; omega = 20 1/s, delta = 1 1/s.
const std::string fading =
    "name = 'fading'\n" + table("parameters", {{"c", "800 N/m"}, {"t_1", "0.7 s"}}) +
    slider_body("mass", "2 kg", "[1, 0, 0]") +
    element("spring", "spring-damper", {{"from", "mass"}, {"stiffness", "c"}, {"damping", "4 N s/m"}}) +
    start("q = { mass = '10 mm' }") + table("run", {{"method", "bdf"}, {"tolerance", "1e-10"}, {"end", "2 s"}}) +
    "[output]\nstep = '5 ms'\n[output.signals]\nx = 'mass.displacement'\nF = 'spring.force'\n";

class Window : public ::testing::Test
{
protected:
  Result run(const std::vector<std::string> &overrides = {}, const std::string &text = fading,
             const std::string &sensitivities = "")
  {
    return differentiated(Session(folder_.write("scene.toml", test::quoted(text)), overrides), sensitivities);
  }

  static const coupling::SignalSummary &signal(const Result &result, const std::string &name)
  {
    for (const coupling::SignalSummary &own : result.run->signals)
      if (own.name == name)
        return own;
    throw std::out_of_range(name);
  }

  test::SceneFolder folder_;
};

double motion(double t, double c = 800.)
{
  const double delta = 1., omega = std::sqrt(c / 2. - delta * delta);
  return 0.01 * std::exp(-delta * t) * (std::cos(omega * t) + delta / omega * std::sin(omega * t));
}

// An oscillation that fades is largest at its first turning point in the window: t = 5 pi/omega.
TEST_F(Window, ExtremesAreThoseBehindItsBeginning)
{
  const double omega = std::sqrt(399.);
  const Result whole = run(), part = run({"output.from=0.7 s"});
  EXPECT_NEAR(signal(whole, "x").max, 0.01, 1e-12);
  EXPECT_NEAR(signal(part, "x").t_max, 6. * M_PI / omega, 1e-6);
  EXPECT_NEAR(signal(part, "x").max, motion(6. * M_PI / omega), 1e-9);
  EXPECT_NEAR(signal(part, "x").t_min, 5. * M_PI / omega, 1e-6);
  EXPECT_NEAR(signal(part, "x").min, motion(5. * M_PI / omega), 1e-9);
  EXPECT_EQ(whole.run->rows, part.run->rows);
}

// Between two turning points on the way down the value at the beginning is the largest, at its very instant.
TEST_F(Window, TheValueAtItsBeginningCounts)
{
  const double t    = 6.1 * M_PI / std::sqrt(399.); // behind the last maximum that is larger
  const Result part = run({"output.from=" + std::to_string(t)});
  EXPECT_NEAR(signal(part, "x").t_max, std::stod(std::to_string(t)), 1e-15);
  EXPECT_NEAR(signal(part, "x").max, motion(std::stod(std::to_string(t))), 1e-9);
}

TEST_F(Window, ThatBeginsWithTheRunChangesNothing)
{
  const Result whole = run(), part = run({"output.from=0"});
  for (std::size_t i = 0; i < whole.run->signals.size(); ++i)
  {
    EXPECT_EQ(whole.run->signals[i].max, part.run->signals[i].max);
    EXPECT_EQ(whole.run->signals[i].t_max, part.run->signals[i].t_max);
    EXPECT_EQ(whole.run->signals[i].min, part.run->signals[i].min);
  }
}

TEST_F(Window, SpectraOfItsRows)
{
  const auto begin = [&](const std::vector<std::string> &overrides)
  {
    Session      session(folder_.write("scene.toml", test::quoted(fading)), overrides);
    const Result result = apps::complete_run(session);
    const auto  *found  = apps::answer_in<apps::RunSpectra>(result.answers);
    return found && found->spectra ? found->spectra->begin : -1.;
  };
  EXPECT_NEAR(begin({"output.from=0.5 s"}), 0.5, 1e-9);
  EXPECT_NEAR(begin({}), 0., 1e-12);
}

// Derivatives against differences of runs: of a maximum inside and of a value at the beginning, which moves with t_1.
TEST_F(Window, DerivativesAreThoseOfItsExtremes)
{
  const auto derivative = [](const Result &result, const std::string &name, std::size_t key)
  {
    for (const auto &output : sensitivities_of(result).outputs)
      if (output.output == name)
        return output.derivative[Eigen::Index(key)];
    throw std::out_of_range(name);
  };
  const double t = std::stod(std::to_string(6.1 * M_PI / std::sqrt(399.))); // as it is written
  const Result part =
      run({"parameters.t_1=" + std::to_string(t), "output.from=t_1"}, fading, "parameters.c,parameters.t_1");
  const double dc = 1e-3, dt = 1e-6;
  EXPECT_NEAR(derivative(part, "x.max", 0), (motion(t, 800. + dc) - motion(t, 800. - dc)) / (2. * dc), 1e-10);
  EXPECT_NEAR(derivative(part, "x.max", 1), (motion(t + dt) - motion(t - dt)) / (2. * dt), 1e-6);
  EXPECT_NEAR(derivative(part, "x.t_max", 0), 0., 1e-12);
  EXPECT_NEAR(derivative(part, "x.t_max", 1), 1., 1e-9);
  EXPECT_NEAR(derivative(part, "x.min", 1), 0., 1e-12);
  const auto turn = [](double c) { return motion(7. * M_PI / std::sqrt(c / 2. - 1.), c); };
  EXPECT_NEAR(derivative(part, "x.min", 0), (turn(800. + dc) - turn(800. - dc)) / (2. * dc), 1e-10);
}

const std::string shaken = std::string(fading) + R"(
[element.shaker]
type = 'force'
from = 'mass'
direction = [1, 0, 0]
harmonics = [{ amplitude = '1 N', frequency = '4 Hz' }, { amplitude = '1 N', frequency = '6 Hz' }]
)";

const std::string turning = std::string(fading) + "[body.shaft]\ntype = 'rotor'\naxis = [0, 0, 1]\ninertia = 1\n";

TEST_F(Window, TheLastPeriodIsTheCommonOneOfTheLoads)
{
  const Result part = run({"output.from=last period"}, shaken);
  EXPECT_NEAR(part.run->from, 1.5, 1e-12);
  EXPECT_GE(signal(part, "x").t_max, 1.5);
  EXPECT_GE(signal(part, "x").t_min, 1.5);
}

TEST_F(Window, TheLastPeriodIsARevolutionWhereNoLoadOscillates)
{
  EXPECT_NEAR(run({"output.from=last period", "start.v.shaft=120 rpm"}, turning).run->from, 1.5, 1e-12);
  expect_refusal([&] { run({"output.from=last period", "start.v.shaft=6 rpm"}, turning); }, "the period is unknown");
}

std::string formula(const std::string &body, const std::string &motion, const std::string &force)
{
  return "[element.formula]\ntype = 'formula force'\nfrom = '" + body + "'\n" + motion + " = [0, 0, 1]\nforce = '" +
         force + "'\n";
}

/// What depends on the time without repeating leaves no period: a ramp in the window, one before it, another period.
TEST_F(Window, WhatDoesNotRepeatLeavesNoLastPeriod)
{
  const auto with = [&](const std::string &force)
  {
    std::string text = shaken;
    return text + "[body.other]\ntype = 'slider'\naxis = [0, 0, 1]\nmass = 1\n" + formula("other", "direction", force);
  };
  expect_refusal([&] { run({"output.from=last period"}, with("1 N/s*t")); },
                 "\"formula\" depends on the time and does not repeat with the period of 0.5 s of the loads");
  EXPECT_EQ(run({"output.from=last period"}, with("1 N/s*min(t, 0.9 s)")).run->from, 1.5);
  EXPECT_EQ(run({"output.from=last period"}, with("1 N*sin(8*pi/(1 s)*t)")).run->from, 1.5);
  expect_refusal(
      [&]
      {
        run({"output.from=last period", "start.v.shaft=120 rpm"},
            turning + formula("shaft", "about", "1 N*m*sin(7/(1 s)*t)"));
      },
      "0.5 s of the initial rotor speed");
}

/// A motion that is a function of the time is known before the run, ramps and motors after it.
TEST_F(Window, ARevolutionNeedsTheSpeedOfTheStart)
{
  const auto driven = [&](const std::string &motion)
  { return turning + "[joint.drive]\ntype = 'prescribed motion'\non = 'shaft'\nmotion = { " + motion + " }\n"; };
  const std::vector<std::string> last = {"output.from=last period", "start.v.shaft=120 rpm"};
  expect_refusal([&] { run(last, driven("function = '4*pi*t/(1 s) + t*t/(1 s^2)'")); },
                 "\"drive\" depends on the time");
  EXPECT_EQ(run(last, driven("function = '4*pi*t/(1 s)'")).run->from, 1.5);
  EXPECT_THAT(
      coupling::texts_of(
          run(last, driven("speed = [{ at = '0.5 s', to = '240 rpm', acceleration = '50 rad/s^2' }], initial_speed = "
                           "'120 rpm'"))
              .run->findings),
      Contains(HasSubstr("but its mean speed is 21.2 rad/s")));
  const std::string torque =
      turning + "[element.torque]\ntype = 'force'\nfrom = 'shaft'\nabout = [0, 0, 1]\nconstant = '1 N m'\n";
  const Result result = run(last, torque);
  EXPECT_THAT(coupling::texts_of(result.run->findings),
              Contains(HasSubstr("but its mean speed is 13.57 rad/s"))); // 4 pi + 1 rad/s
  EXPECT_THAT(coupling::texts_of(run(last, turning).run->findings), Not(Contains(HasSubstr("mean speed"))));
}

TEST_F(Window, WhatMakesNoSenseIsRefused)
{
  expect_refusal([&] { run({"output.from=2 s"}); }, "must be before run.end");
  expect_refusal([&] { run({"output.from=-0.1 s"}); }, "before the start of the run at 0 s");
  expect_refusal(
      [&] {
        run({"run.begin=1 s", "output.from=0.9 s"});
      },
      "output.from: is 0.9 s, before the start of the run");
  expect_refusal([&] { run({"output.from=last turn"}); }, "output.from");
  expect_refusal([&] { run({"output.from=last perod"}); }, "did you mean 'last period'?");
  expect_refusal([&] { run({"output.from=last period"}); }, "the period is unknown");
  expect_refusal([&] { run({"output.from=last period", "run.end=0.4 s"}, shaken); }, "longer than the run");
}

TEST_F(Window, TheSummaryNamesIt)
{
  const Result part = run({"output.from=0.7 s"});
  EXPECT_EQ(part.requested.run->from, 0.7);
}

TEST_F(Window, ComparedRunsOfDifferentWindowsGiveAWarning)
{
  const std::string file     = folder_.write("scene.toml", test::quoted(fading));
  const auto        warnings = [&](const std::string &from)
  {
    Session own(file, {"output.from=0.7 s"}), other(file, {"output.from=" + from});
    Result  result = own.run();
    add_compared_run(own, result, other);
    return result.warnings;
  };
  EXPECT_THAT(warnings("0.5 s"), Contains(HasSubstr("different windows")));
  EXPECT_THAT(warnings("0.7 s"), ::testing::Not(Contains(HasSubstr("different windows"))));
}

} // namespace
} // namespace gestell::tests
