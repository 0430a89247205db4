// The example scenes with position functions: a Geneva drive against exact kinematics, a cam follower that bounces.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

TEST(GenevaDrive, IndexesBySixtyDegreesAndFollowsTheExactPositionFunction)
{
  const SceneRun run("geneva_drive.toml", {"output.picture_step=0"});
  EXPECT_EQ(run.result.failure, "");
  const double n = 6., d = 0.12, a = d * std::sin(M_PI / n), alpha = M_PI / 2. - M_PI / n;
  const auto   exact = [&](double x) // wheel angle, from the triangle of crank and line of centres
  {
    const double turns = std::floor((x + M_PI) / (2. * M_PI)), inner = x - 2. * M_PI * turns;
    const double index = std::abs(inner) < alpha ? std::atan2(a * std::sin(inner), d - a * std::cos(inner))
                                                 : std::copysign(M_PI / n, inner);
    return index + 2. * M_PI / n * turns;
  };
  const auto phi = run.column("phi"), psi = run.column("psi");
  double     error = 0.;
  for (std::size_t i = 0; i < run.n_rows(); ++i)
    error = std::max(error, std::abs(run.at(i, psi) - exact(run.at(i, phi))));
  EXPECT_LT(error, 1e-10); // ideal joints close to rounding; rows between steps behind an event are interpolated
  EXPECT_NEAR(run.signal("psi").final, -M_PI / n + 3. * 2. * M_PI / n, 1e-13);

  // The pin enters at -60 degrees and leaves at 60: a sixth of a second about the middle of every turn of one second.
  for (int turn = 0; turn < 3; ++turn)
  {
    EXPECT_NEAR(time_of(run, "if_1_rises", turn), turn + 0.5 - alpha / (2. * M_PI), 1e-10);
    EXPECT_NEAR(time_of(run, "if_2_rises", turn), turn + 0.5 + alpha / (2. * M_PI), 1e-10);
  }
  EXPECT_LT(run.result.energy.residual, 1e-4 * run.signal("M_drive").max);
}

// At 300 and 600 rpm the spring is stronger than the inertia of the follower, at 900 rpm not.
TEST(CamFollower, LeavesTheCamAtTheThirdSpeedOnly)
{
  const SceneRun run("cam_follower.toml", {"output.picture_step=0"});
  EXPECT_EQ(run.result.failure, "");
  double first  = 2.;
  int    closed = 0, opened = 0;
  for (const coupling::Event &event : run.result.events)
    if (event.name == "contact")
    {
      first = std::min(first, event.t);
      opened += event.kind == "separation";
      closed += event.kind == "contact";
    }
  EXPECT_GT(first, 0.9);
  EXPECT_GT(opened, 20);
  EXPECT_LE(std::abs(opened - closed), 1);
  EXPECT_GT(run.signal("gap").max, 1e-3);
  EXPECT_GT(run.signal("F_C").max, 10. * 120.); // blows, ten times the force of the compressed spring and more
  expect_closed_balance(run, 1e-3);
}

} // namespace
} // namespace gestell::tests
