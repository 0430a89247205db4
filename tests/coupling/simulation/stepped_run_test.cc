// A run that goes on piece by piece: the same steps as a run as a whole, loads that jump between pieces, states.

#include "coupling/simulation/stepped_run.h"

#include "mechanism/elements/clearance.h"
#include "mechanism/elements/profile_force.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

constexpr double block_mass = 2., spring = 800., wall = 2e5, gap = 8e-3; // kg, N/m, N/m, m

/// A sprung mass that an input pushes, between stops.
struct PushedMass
{
  /// @param limit  of the displacement [m], at which a switch ends the run; 0: none
  explicit PushedMass(double play = gap, double limit = 0.)
  {
    MachineModel  model;
    const Measure x = slider(model, "x", block_mass);
    model.add_linear("spring", x, {spring, 0., 0., 0.}, "N");
    model.attach("stops", std::make_shared<mechanism::Clearance>(mechanism::Clearance::Parameters{play, wall, 0.}),
                 {x});
    model.attach("push", std::make_shared<mechanism::ProfileForce>(force), {x});
    if (limit > 0.)
    {
      Switch far;
      far.name   = "far";
      far.signal = "x.displacement";
      far.level  = limit;
      far.ends   = "it is far";
      model.add_switch(far);
    }
    machine.emplace(std::move(model));
  }

  std::vector<Signal> signals() const
  {
    std::vector<Signal> signals;
    for (const char *const path : {"x.displacement", "x.velocity", "stops.force", "x.acceleration"})
      signals.push_back(machine->signal(path, path));
    return signals;
  }

  std::shared_ptr<mechanism::InputValue> force =
      std::make_shared<mechanism::InputValue>(mechanism::InputValue{"F", 5., 0., 0.});
  std::optional<Machine> machine;
};

constexpr double step = 1e-4, end = 0.2, no_stops = 1.;

} // namespace

class SteppedRunBy : public testing::TestWithParam<const char *>
{
protected:
  RunOptions options() const
  {
    const std::string name = GetParam();
    return run_of(method(name, step, name == "exact" ? 6 : 2), end);
  }
};

TEST_P(SteppedRunBy, MovesAsARunWhereverItsPiecesEnd)
{
  PushedMass      one, other, third;
  const RunResult whole = simulate(*one.machine, start(0., 1.), options(), one.signals());
  EXPECT_GT(whole.events.size(), 4u);
  const auto range = [&](int signal) { return whole.signals[signal].max - whole.signals[signal].min; };
  SteppedRun pieces(*other.machine, start(0., 1.), options(), other.signals());
  for (int i = 1; i <= 1400; ++i) // of 1.43 steps each
    pieces.go_on_to(i * end / 1400);
  EXPECT_EQ(pieces.take_events().size(), whole.events.size());
  for (int i = 0; i < 3; ++i) // the wall multiplies what Newton leaves, 1e-10, by some hundred
    EXPECT_NEAR(pieces.values()[i], whole.signals[i].final, 1e-8 * range(i));

  // Of two instants inside a step that an event ends the second one is reached anew, with the error of the method.
  SteppedRun parts(*third.machine, start(0., 1.), options(), third.signals());
  for (int i = 1; i <= 6000; ++i)
    parts.go_on_to(i * end / 6000);
  EXPECT_NEAR(parts.values()[0], whole.signals[0].final, 1e-2 * range(0));
}

TEST_P(SteppedRunBy, ALoadThatJumpsMovesTheRestPosition)
{
  // x = F/c (1 - cos w t) up to t_1, then about F_1/c with what it has there; between stops that are far.
  PushedMass   one(no_stops);
  const double w = std::sqrt(spring / block_mass), t_1 = 0.05, x_0 = 5. / spring, x_1 = -12. / spring;
  SteppedRun   run(*one.machine, start(0., 0.), options(), one.signals());
  const auto   error_at = [&](double x) { return std::abs(run.values()[0] - x); };
  run.go_on_to(t_1);
  one.force->value = -12.;
  run.load_jumped();
  run.go_on_to(end);
  const double q = x_0 * (1. - std::cos(w * t_1)), v = x_0 * w * std::sin(w * t_1), t = end - t_1;
  const double x = x_1 + (q - x_1) * std::cos(w * t) + v / w * std::sin(w * t);
  // Second order, w h = 2e-3: the period errs by (w h)^2/3 at most, over w t = 3 rad.
  EXPECT_LT(error_at(x), 1e-5 * std::abs(x_1));
}

TEST_P(SteppedRunBy, GoesBackToAState)
{
  PushedMass one;
  SteppedRun run(*one.machine, start(0., 1.), options(), one.signals());
  run.go_on_to(0.0501);
  const SteppedState state = run.state();
  run.go_on_to(0.15);
  const std::vector<double> first = run.values();
  run.restore(state);
  EXPECT_NEAR(run.time(), 0.0501, 1e-9 * step);
  run.go_on_to(0.15);
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_NEAR(run.values()[i], first[i], 1e-9 * std::abs(first[i]) + 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Methods, SteppedRunBy, testing::Values("bdf", "newmark", "exact", "generalised-alpha"),
                         [](const auto &info)
                         {
                           std::string name = info.param;
                           for (char &c : name)
                             c = c == '-' ? '_' : c;
                           return name;
                         });

TEST(SteppedRun, EndsInsideAStepAndGoesOnFromThere)
{
  PushedMass   one(no_stops);
  SteppedRun   run(*one.machine, start(0., 0.), run_of(bdf(2, step), end), one.signals());
  const double w = std::sqrt(spring / block_mass);
  for (int i = 1; i <= 37; ++i) // 54.05 steps each
  {
    run.go_on_to(i * end / 37);
    EXPECT_NEAR(run.time(), i * end / 37, 1e-9 * step);
    const double x = 5. / spring * (1. - std::cos(w * run.time()));
    EXPECT_NEAR(run.values()[0], x, 1e-5 * 5. / spring);
  }
}

class EndedRun : public testing::TestWithParam<bool> // events are located, or gone over
{
};

TEST_P(EndedRun, StaysWhereASwitchEndsItInItsStatesToo)
{
  // x = F/c (1 - cos w t) passes the limit at t_1, amid a piece of two thirds of a step as well as of 15 steps.
  const double limit = 5e-3, w = std::sqrt(spring / block_mass), t_1 = std::acos(1. - limit * spring / 5.) / w;
  RunOptions   options = run_of(bdf(2, step), end);
  options.events       = GetParam();
  for (const double piece : {step / 1.5, 15. * step})
  {
    PushedMass one(no_stops, limit), other(no_stops, limit);
    SteppedRun run(*one.machine, start(0., 0.), options, one.signals());
    double     before = 0.;
    for (int i = 1; run.ended().empty() && i * piece < end; ++i)
    {
      run.go_on_to(i * piece);
      EXPECT_GT(run.time(), before);
      EXPECT_LE(run.time(), i * piece + 1e-9 * step);
      before = run.time();
    }
    EXPECT_NE(run.ended(), "");
    EXPECT_NEAR(run.time(), t_1, 1e-3 * step);         // w h = 2e-3: the phase errs by (w h)^2/3 of w t = 0.65
    EXPECT_NEAR(run.values()[0], limit, 1e-6 * limit); // the crossing is drawn straight, within a step
    const SteppedState state = run.state();
    const std::string  ended = run.ended();
    EXPECT_NE(ended, "");
    run.go_on_to(end);
    EXPECT_EQ(run.time(), state.t);
    SteppedRun again(*other.machine, start(0., 0.), options, other.signals());
    again.restore(state);
    EXPECT_EQ(again.ended(), ended);
    again.go_on_to(end);
    EXPECT_EQ(again.time(), state.t);
    again.restore({0., start(0., 0.).q, start(0., 0.).v, other.machine->events().save_history()});
    EXPECT_EQ(again.ended(), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Events, EndedRun, testing::Bool(),
                         [](const auto &info) { return info.param ? "located" : "gone_over"; });

TEST(SteppedRun, ControlsTheErrorOfItsStepsWithinPieces)
{
  PushedMass   one(no_stops);
  SteppedRun   run(*one.machine, start(0., 0.), run_of(controlled(bdf(5, 0.), 1e-8), end), one.signals());
  const double w = std::sqrt(spring / block_mass);
  for (int i = 1; i <= 10; ++i)
    run.go_on_to(i * end / 10);
  EXPECT_NEAR(run.values()[0], 5. / spring * (1. - std::cos(w * end)), 1e-5 * 5. / spring);
}

TEST(SteppedRun, IsCheckedAsARunWhereverItsPiecesEnd)
{
  // BDF 2 with 50 steps in a period takes several per cent of the energy in twenty periods.
  const double     coarse = 2. * M_PI / std::sqrt(spring / block_mass) / 50., periods = 1000. * coarse;
  const RunOptions options = run_of(bdf(2, coarse), periods);
  PushedMass       one(no_stops);
  const RunResult  whole = simulate(*one.machine, start(0., 1.), options, one.signals());
  ASSERT_EQ(whole.findings.size(), 1u);
  EXPECT_EQ(whole.findings[0].id, "energy-balance");
  EXPECT_EQ(whole.findings[0].severity, Severity::warning);
  for (const double piece : {0.7, 1., 12.3})
  {
    PushedMass other(no_stops);
    SteppedRun run(*other.machine, start(0., 1.), options, other.signals());
    for (int i = 1; i * piece * coarse < periods; ++i)
      run.go_on_to(i * piece * coarse);
    run.go_on_to(periods);
    EXPECT_EQ(run.finish(), "");
    EXPECT_EQ(texts_of(run.take_findings()), texts_of(whole.findings)) << piece;
  }
}

TEST(SteppedRun, WhatWasForgottenCountsForNoCheck)
{
  // A load that jumps in each piece of 1.43 steps takes back 0.57 of a step: counted twice, the work of that part would
  // open the balance by a quarter of the input, and one per cent is a warning.
  PushedMass   one(no_stops);
  SteppedRun   run(*one.machine, start(0., 1.), run_of(bdf(2, step), end), one.signals());
  SteppedState middle;
  const auto   go_on = [&](int from, int to)
  {
    for (int i = from; i < to; ++i)
    {
      run.go_on_to((i + 1) * end / 1400);
      one.force->value = i % 3 * 20. + 5.;
      run.load_jumped();
    }
  };
  go_on(0, 700);
  middle = run.state();
  go_on(700, 1400);
  run.restore(middle);
  go_on(700, 1400);
  EXPECT_EQ(run.finish(), "");
  EXPECT_EQ(texts_of(run.take_findings()), std::vector<std::string>());
}

} // namespace gestell::tests
