// The press with two lumped masses against its reference solution (tests/reference/press).

#include "apps/scene/build/build_machine.h"
#include "coupling/modes/modes.h"
#include "tests/support/csv_table.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

const std::string source = GESTELL_SOURCE_DIR;

double reference_peak(const std::string &file, const std::string &name)
{
  return CsvTable(source + "/tests/reference/press/" + file).number("name", name, "value");
}

// The reference's own second method agrees to 1e-4 N; BDF2 at h = 1e-5 s with located events errs by 4.6 and 2.2 N: 0.1
// % is the bound asked for, 6e-6 what an unbroken implementation reaches.
TEST(PressMinimal, PeaksOfTheRodForceMeetTheReference)
{
  const SceneRun press("press_minimal.toml");
  EXPECT_NEAR(press.signal("F_P").max, reference_peak("peaks.csv", "F_P_max"), 6e-6 * 1056632.);
  EXPECT_NEAR(press.signal("F_P").min, reference_peak("peaks.csv", "F_P_min"), 6e-6 * 601647.);
  EXPECT_NEAR(press.signal("M_T").max, reference_peak("peaks.csv", "M_T_max"), 1e-4 * 52430.);
  EXPECT_NEAR(press.signal("F_col").max, reference_peak("peaks.csv", "F_column_max"), 1e-4 * 941884.);
  EXPECT_NEAR(press.signal("F_F").max, reference_peak("peaks.csv", "F_foundation_max"), 1e-4 * 401635.);
  EXPECT_NEAR(press.signal("x1").min, reference_peak("peaks.csv", "x1_min"), 1e-4 * 1.6e-4);
  EXPECT_NEAR(press.signal("x2").max, reference_peak("peaks.csv", "x2_max"), 1e-4 * 9.4e-4);
}

TEST(PressMinimal, EventsUpToTheFirstRecontactComeInOrderAndInTime)
{
  const SceneRun press("press_minimal.toml");
  const CsvTable reference(source + "/tests/reference/press/events.csv");
  for (int i = 0; i < 16; ++i) // the 16th is conrod_close_compression
  {
    ASSERT_LT(i, static_cast<int>(press.result.events.size()));
    EXPECT_EQ(press.result.events[i].kind, reference.text(i, "event"));
    EXPECT_NEAR(press.result.events[i].t, reference.number(i, "t"), 2e-6);
  }
  EXPECT_EQ(press.result.events.size(), 44u);
}

TEST(PressMinimal, EventTimesConvergeWithTheSecondPowerOfTheStep)
{
  const SceneRun coarse("press_minimal.toml"), fine("press_minimal.toml", {"run.step=\"2.5 us\""});
  const CsvTable reference(source + "/tests/reference/press/events.csv");
  double         error[2] = {0., 0.};
  for (int i = 0; i < 16; ++i)
  {
    error[0] = std::fmax(error[0], std::abs(coarse.result.events[i].t - reference.number(i, "t")));
    error[1] = std::fmax(error[1], std::abs(fine.result.events[i].t - reference.number(i, "t")));
  }
  EXPECT_LT(error[1], 2e-7);
  EXPECT_NEAR(std::log2(error[0] / error[1]) / 2., 2., 0.3);
}

// The reference's own second method differs from it by 4e-9 s in the tool's times and by 1e-9 N in F_P; what the
// methods here leave was seen to be 3e-11 s and 6e-9, and 9e-11 s and 3e-10.
TEST(PressMinimal, MethodsOfHighOrderMeetTheReferenceToRounding)
{
  const CsvTable reference(source + "/tests/reference/press/events.csv");
  for (const std::vector<std::string> &settings :
       {std::vector<std::string>{"run.method=exact", "run.order=6", "run.step=\"100 us\""}, {"run.tolerance=1e-8"}})
  {
    const SceneRun press("press_minimal.toml", settings);
    ASSERT_EQ(press.result.events.size(), 44u);
    for (int i = 0; i < 16; ++i)
      EXPECT_NEAR(press.result.events[i].t, reference.number(i, "t"), 1e-9) << settings[0] << ' ' << i;
    EXPECT_NEAR(press.signal("F_P").max, reference_peak("peaks.csv", "F_P_max"), 5e-8 * 1056632.) << settings[0];
    EXPECT_NEAR(press.signal("F_P").min, reference_peak("peaks.csv", "F_P_min"), 5e-8 * 601647.) << settings[0];
    EXPECT_LT(press.result.energy.residual, 1e-7 * press.result.energy.input) << settings[0];
  }
}

TEST(PressMinimal, EveryMethodRunsIt)
{
  for (const char *method : {"newmark", "wilson", "hht", "generalised-alpha", "central-difference", "exact"})
  {
    const SceneRun press("press_minimal.toml", {std::string("run.method=") + method});
    EXPECT_EQ(press.result.failure, "") << method;
    EXPECT_EQ(press.result.events.size(), 44u) << method;
    EXPECT_NEAR(press.signal("F_P").max, reference_peak("peaks.csv", "F_P_max"), 5e-6 * 1056632.) << method;
    EXPECT_NEAR(press.signal("F_P").min, reference_peak("peaks.csv", "F_P_min"), 3e-5 * 601647.) << method;
  }
}

TEST(PressMinimal, EnergyIsBalancedToTheSecondOrderOfTheStep)
{
  const SceneRun fine("press_minimal.toml"), coarse("press_minimal.toml", {"run.step=\"40 us\""});
  // 2.8 mJ of 4810 J at 10 us, 0.65 mJ at 5 us.
  EXPECT_NEAR(fine.result.energy.input, reference_peak("peaks.csv", "work_of_motor"), 4e-3);
  EXPECT_LT(fine.result.energy.residual, 1e-5 * fine.result.energy.input);
  EXPECT_GT(coarse.result.energy.residual / fine.result.energy.residual, 6.);
}

// The rigid turn with the play open is exactly zero; sqrt(eps) of the highest frequency is what rounding leaves of it.
TEST(PressMinimal, FrequenciesMeetTheReferenceWithThePlayClosedAndOpen)
{
  const Scene       scene   = read_scene(shipped("press_minimal.toml"));
  coupling::Machine machine = build_machine(scene);
  const CsvTable    reference(source + "/tests/reference/press/modes.csv");
  for (const bool open : {false, true})
  {
    const std::string position = open ? "20deg_before_BDC_gap_open" : "20deg_before_BDC";
    const auto        modes    = coupling::coupled_modes(machine, modes_configuration(scene, machine),
                                               open ? std::vector<std::string>{"rod"} : scene.modes.open, 5);
    int               j        = 0;
    for (int row = 0; row < reference.rows(); ++row)
      if (reference.text(row, "position") == position)
      {
        const double expected = reference.number(row, "f_undamped_Hz");
        EXPECT_NEAR(modes[j].frequency_hz, expected,
                    j > 0  ? 1e-9 * expected
                    : open ? 1e-5
                           : 1e-6 * expected)
            << position << " mode " << j + 1;
        if (j > int(open)) // the oil film acts in the gap, too
        {
          EXPECT_NEAR(modes[j].damping_ratio, reference.number(row, "damping_ratio"), 1e-6) << position;
        }
        if (j > 0 && !open)
        {
          EXPECT_NEAR(modes[j].damped_frequency_hz, reference.number(row, "f_damped_Hz"), 1e-6 * expected);
        }
        ++j;
      }
    EXPECT_EQ(j, 5) << position;
  }
}

TEST(PressMinimal, SteadyInitialStateReproducesTheGivenOne)
{
  const Scene       scene   = read_scene(shipped("press_minimal.toml"));
  coupling::Machine machine = build_machine(scene);
  const auto        given   = initial_state(scene, machine);
  const auto        steady  = coupling::steady_start(
              machine,
              {{{"crank", 2.0943951023931953}}, {{"crank", 3.141592653589793}, {"flywheel", 3.141592653589793}}, "flywheel"});
  // Printed with 16 digits; x1, x2 of 6e-4 m carry the rounding of the equilibrium, 1e-16 of angles of 2 rad.
  EXPECT_LT((given.q - steady.q).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((given.v - steady.v).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(PressMinimal, LightVariantMeetsItsReference)
{
  const SceneRun press("press_minimal_light.toml");
  EXPECT_NEAR(press.signal("F_P").max, reference_peak("peaks_light.csv", "F_P_max"), 5e-5 * 1051403.);
  EXPECT_NEAR(press.signal("F_P").min, reference_peak("peaks_light.csv", "F_P_min"), 5e-5 * 501089.);
}

TEST(PressMinimal, StiffnessOfTheFrameMattersToTheReboundPeak)
{
  const SceneRun soft("press_minimal.toml"), stiff("press_minimal.toml", {"parameters.c_G=\"3200000 kN/mm\""});
  EXPECT_GT(std::abs(stiff.signal("F_P").min - soft.signal("F_P").min), 0.02 * 601647.);
}

} // namespace
} // namespace gestell::tests
