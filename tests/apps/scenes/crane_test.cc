// The mobile crane, built in a scene from bodies, joints, wheels and a switch, against its reference
// (tests/reference/crane).

#include "coupling/modes/modes.h"
#include "tests/support/csv_table.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

const std::string reference = std::string(GESTELL_SOURCE_DIR) + "/tests/reference/crane/";

std::string with_step(const std::string &step)
{
  return "run.step=\"" + step + "\"";
}

/// Largest deviation of the times of all events from those of the reference.
double event_error(const SceneRun &run, const std::string &wheels)
{
  const CsvTable   events(reference + "events.csv");
  std::vector<int> rows;
  for (int i = 0; i < events.rows(); ++i)
    if (events.text(i, "wheel_model") == wheels)
      rows.push_back(i);
  EXPECT_EQ(run.result.events.size(), rows.size());
  const std::map<std::string, std::string> words = {{"limiter switch", "trigger_brake_start"},
                                                    {"cylinder braking_ends", "brake_end"},
                                                    {"rear lift_off", "lift_off_rear"},
                                                    {"rear touch_down", "touch_down_rear"}};
  double                                   error = 0.;
  for (std::size_t i = 0; i < std::min(rows.size(), run.result.events.size()); ++i)
  {
    const auto &event = run.result.events[i];
    EXPECT_EQ(words.at(event.name + " " + event.kind), events.text(rows[i], "event"));
    error = std::max(error, std::abs(event.t - events.number(rows[i], "t")));
  }
  return error;
}

/// Largest relative deviation of the extremes behind the trigger.
double peak_error(const SceneRun &run, const std::string &wheels)
{
  const CsvTable peaks(reference + "peaks.csv");
  double         error = 0.;
  int            found = 0;
  for (int i = 0; i < peaks.rows(); ++i)
  {
    const std::string quantity = peaks.text(i, "quantity");
    if (peaks.text(i, "wheel_model") != wheels || quantity == "a2") // a rotational acceleration, which is no signal
      continue;
    const auto  &signal = run.signal(quantity);
    const double value = peaks.number(i, "value"), scale = std::max(std::abs(signal.min), std::abs(signal.max));
    error = std::max(error, std::abs((peaks.text(i, "kind") == "min" ? signal.min : signal.max) - value) / scale);
    ++found;
  }
  EXPECT_EQ(found, 16);
  return error;
}

TEST(Crane, WithTheSettingsOfTheScene)
{
  const SceneRun run("crane_minimal.toml");
  EXPECT_LT(event_error(run, "bilateral"), 1e-7);
  EXPECT_LT(peak_error(run, "bilateral"), 1e-5);
  // Against the weight lifted and the springs, 6.5e5 J.
  EXPECT_LT(run.result.energy.residual, 1e-8 * 6.5e5);
}

TEST(Crane, ErrorsFallWithTheSquareOfTheStep)
{
  const SceneRun coarse("crane_minimal.toml", {with_step("1 ms")}), fine("crane_minimal.toml", {with_step("0.5 ms")});
  EXPECT_NEAR(std::log2(event_error(coarse, "bilateral") / event_error(fine, "bilateral")), 2., 0.1);
  EXPECT_NEAR(std::log2(peak_error(coarse, "bilateral") / peak_error(fine, "bilateral")), 2., 0.1);
}

TEST(Crane, GeneralisedAlphaFindsTheSame)
{
  const SceneRun run("crane_minimal.toml",
                     {"run.method=\"generalised-alpha\"", "run.rho_inf=0.9", with_step("0.2 ms")});
  EXPECT_LT(event_error(run, "bilateral"), 1e-6);
  EXPECT_LT(peak_error(run, "bilateral"), 1e-5);
}

TEST(Crane, TyresThatLiftOff)
{
  const SceneRun run("crane_minimal_lift.toml");
  EXPECT_LT(event_error(run, "unilateral"), 1e-6);
  EXPECT_LT(peak_error(run, "unilateral"), 1e-5);
  EXPECT_LT(run.result.energy.residual, 1e-8 * run.result.energy.exchanged);
}

// Equilibrium and drift are given as numbers in the reference: q to 16 digits, v to 12.
TEST(Crane, StaticInitialStateWithItsDriftIsThatOfTheReference)
{
  const apps::Scene scene =
      apps::read_scene(shipped("crane_minimal.toml"), {"start.rule=\"static\"", "start.drift=true"});
  coupling::Machine machine = apps::build_machine(scene);
  const auto        start   = apps::initial_state(scene, machine);
  const auto        lift    = machine.model().measure("q1").evaluate(start.q, start.v),
             rope           = machine.model().measure("q3").evaluate(start.q, start.v);
  const int pitch           = machine.model().coordinate("chassis.angle");
  EXPECT_NEAR(lift.s, -0.0417471501960756, 1e-13);
  EXPECT_NEAR(start.q[pitch], -0.0110552957824447, 1e-13);
  EXPECT_NEAR(rope.s, 0., 1e-13);
  EXPECT_NEAR(lift.rate, 0.000385488344692, 1e-13);
  EXPECT_NEAR(start.v[pitch], -0.00165219387, 1e-10); // nine digits are given
}

// Stage 3 of the reference: the cylinder stands at 2.752989795 m, the load hangs at rest.
TEST(Crane, NaturalFrequenciesAboutItsEquilibrium)
{
  const apps::Scene scene   = apps::read_scene(shipped("crane_minimal.toml"),
                                               {"start.rule=\"static\"", "joint.cylinder.length=\"2.752989795 m\""});
  coupling::Machine machine = apps::build_machine(scene);
  const auto        modes   = coupling::coupled_modes(machine, apps::modes_configuration(scene, machine), {}, 20);
  // frequency [Hz] undamped and damped, damping ratio; q4 is given to 1e-9 m, which moves frequencies by some 1e-9
  const double                expected[3][3] = {{0.404110925659008, 0.404116784280382, 0.0040894005004324},
                                                {1.24538338664754, 1.24458868789087, 0.0351425609221216},
                                                {2.60460937346, 2.59659464702923, 0.0783594082436467}};
  std::vector<coupling::Mode> vibrating; // the load moves freely out of the plane
  for (const auto &mode : modes)
    if (mode.frequency_hz > 0.01 && std::abs(mode.shape[machine.model().coordinate("load.uy")]) < 1e-6)
      vibrating.push_back(mode);
  ASSERT_EQ(vibrating.size(), 3u);
  for (int j = 0; j < 3; ++j)
  {
    EXPECT_NEAR(vibrating[j].frequency_hz, expected[j][0], 1e-6 * expected[j][0]);
    EXPECT_NEAR(vibrating[j].damped_frequency_hz, expected[j][1], 1e-6 * expected[j][1]);
    EXPECT_NEAR(vibrating[j].damping_ratio, expected[j][2], 1e-6 * expected[j][2]);
  }
}

} // namespace
} // namespace gestell::tests
