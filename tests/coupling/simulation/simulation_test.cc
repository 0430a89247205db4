// A run as a whole: its end, its events, what it refuses and what it warns of.

#include "mechanism/elements/clearance.h"
#include "tests/support/methods.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;
using namespace gestell::coupling;

constexpr double mass = 3., wall = 2e4, gap = 0.01, speed = 0.5;

/// A mass that flies with 0.5 m/s from the middle of a play of +-10 mm against its stops, without loss.
Machine in_play()
{
  MachineModel model;
  const int    x = model.add_slider("x", {1., 0., 0.}, mass, "ground");
  model.attach("play", std::make_shared<mechanism::Clearance>(mechanism::Clearance::Parameters{gap, wall, 0.}),
               {{{x, 1.}}});
  return Machine(std::move(model));
}

const InitialState flight = tests::start(0., speed);

RunOptions bdf2(double step, double end)
{
  return tests::run_of(tests::bdf(2, step), end);
}

RunResult run(const RunOptions &options, std::vector<std::string> paths = {"x.displacement", "play.force"})
{
  Machine             machine = in_play();
  std::vector<Signal> signals;
  for (const std::string &path : paths)
    signals.push_back(machine.signal(path, path));
  return simulate(machine, flight, options, signals);
}

const double contact_omega = std::sqrt(wall / mass), touch = gap / speed, half_period = M_PI / contact_omega;

TEST(Run, MeetsThePeakOfTheContactForceAndItsInstant)
{
  // The force is m omega v sin(omega (t - touch)).  BDF2: relative error of the amplitude ((omega h)^4/4 per step) and
  // of the period
  // ((omega h)^2/3) after a quarter of it; omega h = 8e-3, so the parabola must not spoil 2e-5.
  const RunResult result = run(bdf2(1e-4, 0.05));
  const auto     &force  = result.signals[1];
  EXPECT_NEAR(force.max, mass * contact_omega * speed, 2e-5 * mass * contact_omega * speed);
  EXPECT_NEAR(force.t_max, touch + 0.5 * half_period, 1e-5);
}

TEST(Run, EventsAreLocatedBetweenTheSteps)
{
  const RunResult result = run(bdf2(1e-4, 0.1));
  ASSERT_EQ(result.events.size(), 3u);
  EXPECT_NEAR(result.events[0].t, touch, 1e-12);
  EXPECT_NEAR(result.events[1].t, touch + half_period, 2e-6); // (omega h)^2/3 of half a period and the start of BDF2
  EXPECT_EQ(result.events[0].name, "play");
}

TEST(Run, ForcesAtRowsAreThoseOfTheBranchTheyLieOn)
{
  const RunResult result = run(bdf2(1e-4, 0.1));
  for (std::size_t i = 0; i < result.rows.size(); i += result.columns.size())
  {
    const double x = result.rows[i + 1], p = result.rows[i + 2];
    EXPECT_NEAR(p, x > gap ? wall * (x - gap) : x < -gap ? wall * (x + gap) : 0., 1e-6 * wall * gap) << result.rows[i];
  }
}

TEST(Run, EndsExactlyAtItsEnd)
{
  for (const double end : {0.05, 0.0512345, 0.03 + 1e-7})
  {
    const RunResult result = run(bdf2(1e-4, end));
    const auto      last   = result.rows.size() - result.columns.size();
    EXPECT_NEAR(result.rows[last], end, 1e-15);
    EXPECT_EQ(result.signals[0].final, result.rows[last + 1]);
    for (const Event &event : result.events)
      EXPECT_LE(event.t, end);
  }
}

TEST(Run, WithoutLocatedEventsTheyAreStillTold)
{
  RunOptions options   = bdf2(1e-4, 0.1);
  options.events       = false;
  const RunResult over = run(options), located = run(bdf2(1e-4, 0.1));
  ASSERT_EQ(over.events.size(), located.events.size());
  for (std::size_t i = 0; i < over.events.size(); ++i)
  {
    EXPECT_EQ(over.events[i].kind, located.events[i].kind);
    EXPECT_NEAR(over.events[i].t, located.events[i].t, 2e-4);
  }
}

TEST(Run, RowsOfTheEnergyBalanceCloseToo)
{
  RunOptions options       = bdf2(1e-4, 0.1);
  options.output_step      = 0.7e-4; // between the steps
  const RunResult   result = run(options);
  const double      scale  = 0.5 * mass * speed * speed;
  const std::size_t n      = result.columns.size();
  for (std::size_t i = 0; i < result.rows.size(); i += n)
    EXPECT_NEAR(result.rows[i + n - 3] - result.rows[i + n - 2] - result.rows[i + n - 1], 0., 2e-4 * scale);
  EXPECT_LT(result.energy.residual, 2e-4 * scale);
}

TEST(Run, CountsItsWork)
{
  const RunResult result = run(bdf2(1e-4, 0.1));
  EXPECT_EQ(result.method, "BDF 2");
  EXPECT_GE(result.work.steps, 1000);
  EXPECT_LE(result.work.steps, 1010); // a new grid after each of three events
  EXPECT_GT(result.work.newton, 0);
  EXPECT_EQ(result.work.chatter, 0);
}

std::string refusal(const RunOptions &options, const Machine &machine)
{
  return tests::refusal([&] { check_run(machine, options, 2); });
}

TEST(Run, RefusesAStepOfHalfThePeriodOfALoad)
{
  MachineModel model;
  const int    x = model.add_slider("x", {1., 0., 0.}, mass, "ground");
  model.add_load("shaker", {{x, 1.}}, 0., {{2. * M_PI * 50., 4., 0.}}, "N");
  Machine machine(std::move(model));
  EXPECT_EQ(refusal(bdf2(0.0099, 1.), machine), "");
  const std::string text = refusal(bdf2(0.01001, 1.), machine);
  EXPECT_NE(text.find("50 Hz"), std::string::npos) << text;
  EXPECT_NE(text.find("0.001 s"), std::string::npos) << text; // a twentieth of 20 ms
}

TEST(Run, AsksBackBeforeItFillsGigabytes)
{
  const Machine machine = in_play();
  RunOptions    options = bdf2(1e-6, 30.); // 3e7 rows of t, 2 signals and 3 energies, 8 bytes each: 1.44 GB
  const auto    text    = refusal(options, machine);
  EXPECT_NE(text.find("1.44 GB of history"), std::string::npos) << text;
  EXPECT_NE(text.find("output.step"), std::string::npos) << text;
  options.allow_large = true;
  EXPECT_EQ(refusal(options, machine), "");
  options.allow_large = false;
  options.output_step = 1e-4;
  EXPECT_EQ(refusal(options, machine), "");
  options.picture_step = 1e-7;
  EXPECT_NE(refusal(options, machine).find("output.picture_step"), std::string::npos);
}

TEST(Run, WarnsOfALoadAboveWhatTheReducedFrameHolds)
{
  ReducedFrame frame;
  frame.M = frame.C        = Eigen::MatrixXd::Identity(1, 1);
  frame.B                  = Eigen::MatrixXd::Zero(1, 1);
  frame.n_interface        = 1;
  frame.translations_load  = Eigen::MatrixXd::Zero(1, 3);
  frame.frequency_limit_hz = 30.;
  for (const double frequency : {29., 31.})
  {
    MachineModel model;
    model.set_frame(frame);
    model.add_load("shaker", {{0, 1.}}, 0., {{2. * M_PI * frequency, 4., 0.}}, "N");
    Machine    machine(std::move(model));
    RunOptions options     = bdf2(1e-3, 0.01);
    options.energy         = false; // ten steps are no run
    const RunResult result = simulate(machine, tests::start(0., 0.), options, {});
    EXPECT_EQ(result.findings.size(), frequency > 30. ? 1u : 0u);
    if (frequency > 30.)
    {
      EXPECT_NE(result.findings.at(0).text.find("31 Hz"), std::string::npos) << result.findings[0].text;
    }
  }
}

TEST(Run, AnUnstableMethodIsRefusedUnlessForced)
{
  Machine    machine   = tests::spring_and_mass(mass, wall);
  RunOptions options   = bdf2(1e-2, 1.); // omega h = 0.8 lies in BDF 4's unstable interval
  options.method.order = 4;
  tests::expect_refusal([&] { simulate(machine, flight, options, {}); }, "unstable");
  options.force_unstable  = true;
  const auto      signal  = machine.signal("x", "x.displacement");
  const RunResult result  = simulate(machine, flight, options, {signal});
  const double    largest = std::max(result.signals[0].max, -result.signals[0].min);
  EXPECT_GT(largest, 3. * speed / contact_omega); // it has grown: (1 + (omega h)^4/4)^100
  ASSERT_FALSE(result.findings.empty());
  EXPECT_NE(result.findings[0].text.find("unstable"), std::string::npos);
  ASSERT_FALSE(result.accuracy.empty());
  EXPECT_TRUE(result.accuracy[0].unstable);
}

} // namespace
