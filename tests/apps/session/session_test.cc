// A scene computed without a terminal: values, progress by a callback, interruption by a flag.

#include "apps/session/session.h"
#include "coupling/modes/modes.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;
using apps::Session;
using test::SceneFolder;

/// A mass of 2 kg on a spring of 800 N/m: omega = 20 1/s, x(t) = 10 mm cos(omega t).
const std::string oscillator = R"toml(
[body.slide]
type = "slider"
axis = [1, 0, 0]
mass = "2 kg"
[element.spring]
type      = "spring-damper"
from      = "slide"
stiffness = "800 N/m"
[start]
q = { slide = "10 mm" }
[run]
method = "newmark"
step   = "0.1 ms"
end    = "0.5 s"
[output]
signals = { x = "slide.displacement" }
step    = "10 ms"
)toml";

} // namespace

TEST(Session, GivesModesOfTheMachineAsValues)
{
  const SceneFolder folder;
  Session           session(folder.write("scene.toml", oscillator));
  const auto        modes = session.modes();
  ASSERT_EQ(modes.coupled_modes.size(), 1u);
  EXPECT_NEAR(2. * M_PI * modes.coupled_modes[0].frequency_hz, 20., 1e-9);
  EXPECT_FALSE(modes.run);
}

TEST(Session, GivesTheRunWithEverySignal)
{
  const SceneFolder folder;
  Session           session(folder.write("scene.toml", oscillator), {"run.end=0.3"});
  const auto        result = session.run();
  ASSERT_TRUE(result.run);
  ASSERT_EQ(result.run->signals.size(), 1u);
  // Average acceleration makes periods longer by (omega h)^2 / 12, here a phase of 2e-6 after 0.3 s.
  const double omega = 20., h = 1e-4, t = 0.3, phase = omega * t * omega * omega * h * h / 12.;
  EXPECT_NEAR(result.run->signals[0].final, 1e-2 * std::cos(omega * t), 2. * 1e-2 * phase);
  EXPECT_EQ(result.requested.set, std::vector<std::string>{"run.end=0.3"});
}

TEST(Session, TellsEveryPhaseToItsWatch)
{
  const SceneFolder        folder;
  std::vector<std::string> phases;
  const auto               watch = [&](const std::string &phase, double)
  {
    if (phases.empty() || phases.back() != phase)
      phases.push_back(phase);
  };
  Session session(folder.write("scene.toml", oscillator), {}, fem::Scripts::harmless, {watch});
  session.run();
  EXPECT_EQ(phases, (std::vector<std::string>{"frame", "start", "modes", "integration", "results"}));
  ASSERT_EQ(session.wall_seconds().size(), phases.size());
  for (std::size_t i = 0; i < phases.size(); ++i)
    EXPECT_EQ(session.wall_seconds()[i].first, phases[i]);
}

TEST(Session, KeepsWhatWasComputedUpToAnInterruption)
{
  const SceneFolder folder;
  std::atomic<bool> stop{false};
  const auto        watch = [&](const std::string &phase, double share)
  { stop = stop || (phase == "integration" && share > 0.5); };
  Session    session(folder.write("scene.toml", oscillator), {}, fem::Scripts::harmless, {watch, &stop});
  const auto result = session.run();
  ASSERT_TRUE(result.run);
  EXPECT_TRUE(result.run->interrupted);
  const auto  &run  = *result.run;
  const double last = run.rows[run.rows.size() - run.columns.size()]; // [s]
  EXPECT_GE(last, 0.25);
  EXPECT_LT(last, 0.35);
}

TEST(Session, RefusesARunThatTheSceneDoesNotDescribe)
{
  const SceneFolder folder;
  Session           session(folder.write("scene.toml", oscillator.substr(0, oscillator.find("[run]"))));
  EXPECT_THROW(session.run(), std::invalid_argument);
  EXPECT_EQ(session.modes().coupled_modes.size(), 1u);
}
