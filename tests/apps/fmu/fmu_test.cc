// Machines as FMUs, stepped by a master of our own: the same motion as that of a run, and the error of a coupling.

#include "tests/apps/fmu/exported_fmu.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// Both, with the spring between them that the master computes in the tests.
const std::string both =
    slider_body("one", "2 kg", "[1, 0, 0]") + slider_body("two", "3 kg", "[1, 0, 0]") +
    element("first", "spring-damper", {{"from", "one"}, {"stiffness", "800 N/m"}, {"damping", "2 N s/m"}}) +
    element("second", "spring-damper", {{"from", "two"}, {"stiffness", "500 N/m"}, {"damping", "2 N s/m"}}) +
    element("between", "spring-damper", {{"from", "one"}, {"to", "two"}, {"stiffness", "600 N/m"}}) +
    start("rule = 'given'\nq = { one = '10 mm' }") + steps("0.05 ms", "0.4 s", {{"method", "newmark"}}) +
    "[output.signals]\nx1 = \"one.displacement\"\nx2 = \"two.displacement\"\n";

constexpr double between = 600.; // N/m

enum class Between
{
  held,
  extrapolated
};

/// Error of the displacements at 0.4 s, of two FMUs whose spring between them is computed every H.
double coupling_error(const Fmu &first, const Fmu &second, double H, Between how, double x1, double x2)
{
  FmuInstance one(first, "first"), two(second, "second");
  EXPECT_EQ(one.start(), fmi2OK) << one.last_message();
  EXPECT_EQ(two.start(), fmi2OK) << two.last_message();
  const int steps = int(std::lround(0.4 / H));
  for (int i = 0; i < steps; ++i)
  {
    const double force = between * (two.get("x") - one.get("x")), rate = between * (two.get("v") - one.get("v"));
    for (const auto &[instance, sign] : {std::pair{&one, 1.}, std::pair{&two, -1.}})
    {
      EXPECT_EQ(instance->set("F", sign * force), fmi2OK);
      if (how == Between::extrapolated)
      {
        EXPECT_EQ(instance->set_rate("F", sign * rate), fmi2OK);
      }
      EXPECT_EQ(instance->step(i * H, H), fmi2OK) << instance->last_message();
    }
  }
  return std::hypot(one.get("x") - x1, two.get("x") - x2);
}

} // namespace

TEST(Fmu, IsDescribedAsTheStandardDemands)
{
  const Folder   folder("fmu_description");
  const Exported press(folder, "press", scene("press_minimal.toml"), "--inputs F=slide,frame.crown.uz,crank");
  const Fmu     &fmu = *press.fmu;
  EXPECT_EQ(fmu.head().at("fmiVersion"), "2.0");
  EXPECT_EQ(fmu.co_simulation().at("modelIdentifier"), "press_minimal");
  EXPECT_THAT(fmu.named("input"), testing::UnorderedElementsAre("F", "frame.crown.uz", "crank"));
  EXPECT_EQ(fmu.named("output").size(), 14u);
  EXPECT_THAT(fmu.named("parameter"), testing::AllOf(testing::Contains("c_P"), testing::Contains("s_cl")));
  EXPECT_THAT(fmu.named("parameter"), testing::Not(testing::Contains("F_max"))); // follows from others
  EXPECT_THAT(fmu.named("parameter"), testing::Not(testing::Contains("t_end"))); // is no limit
  std::set<std::string> names, units(fmu.units().begin(), fmu.units().end());
  std::set<unsigned>    references;
  for (std::size_t i = 0; i < fmu.scalars().size(); ++i)
  {
    const FmuScalar &scalar = fmu.scalars()[i];
    EXPECT_TRUE(names.insert(scalar.name).second) << scalar.name;
    EXPECT_TRUE(references.insert(scalar.reference).second) << scalar.name;
    EXPECT_TRUE(scalar.unit.empty() || units.count(scalar.unit) > 0) << scalar.unit;
    const bool output = scalar.causality == "output";
    EXPECT_EQ(scalar.starts, !output) << scalar.name;
    EXPECT_EQ(std::count(fmu.outputs().begin(), fmu.outputs().end(), int(i + 1)), output ? 1 : 0) << scalar.name;
  }
  FmuInstance instance(fmu);
  EXPECT_EQ(instance.get("s_cl"), 0.4e-3);
  EXPECT_EQ(instance.get("c_P"), 9e8);
}

TEST(Fmu, MovesAsARunOfTheSameScene)
{
  const Folder folder("fmu_run");
  ASSERT_EQ(gestell("run " + scene("press_minimal.toml") + " --set output.step='\"1 ms\"' --set output.picture_step=0" +
                    folder.option())
                .exit_code,
            0);
  const Exported press(folder, "press", scene("press_minimal.toml"));
  // Inputs do not change, so that the steps are those of the run: what is left is the rounding of its table.
  EXPECT_LT(difference_from_run(*press.fmu, folder.results() / "history.csv"), 1e-9);
}

TEST(Fmu, AnInputThatJumpsIsACornerOfAProfile)
{
  const Folder      folder("fmu_profile");
  const std::string pushed = "extends = \"" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml\"\n"
                             "[output]\nstep = \"1 ms\"\npicture_step = 0\n"
                             "[element.push]\ntype = \"force profile\"\nfrom = \"slide\"\ninitial = \"2 kN\"\n"
                             "profile = [{ at = \"0.1 s\", to = \"-30 kN\" }, { at = \"0.15 s\", to = \"10 kN\" }]\n";
  ASSERT_EQ(gestell("run " + folder.file("pushed.toml", pushed) + folder.option()).exit_code, 0);
  const Exported press(folder, "press", scene("press_minimal.toml"), "--inputs F=slide");
  // Both restart there, the run by a cut of its step, the FMU from its dense output: the error of a few steps of 1e4.
  EXPECT_LT(
      difference_from_run(*press.fmu, folder.results() / "history.csv", {{"F", 2e3}}, {{100, -30e3}, {150, 10e3}}),
      1e-4);
  EXPECT_GT(difference_from_run(*press.fmu, folder.results() / "history.csv"), 1e-3); // the force does something
}

TEST(Fmu, TakesTheSameStepsWhereverItCommunicates)
{
  const Folder   folder("fmu_inside");
  const Exported press(folder, "press", scene("press_minimal.toml"));
  FmuInstance    whole(*press.fmu, "whole"), parts(*press.fmu, "parts");
  ASSERT_EQ(whole.start(), fmi2OK);
  ASSERT_EQ(parts.start(), fmi2OK);
  EXPECT_EQ(whole.step(0., 0.4), fmi2OK);
  for (int i = 0; i < 6000; ++i) // of six steps and two thirds
    ASSERT_EQ(parts.step(i * 0.4 / 6000, 0.4 / 6000), fmi2OK) << parts.last_message();
  // Velocities inside a step are differences of positions, which leaves epsilon q / h of rounding: 1e-10 rad/s of the
  // flywheel, on whose slip the motor depends.
  for (const std::string &signal : press.fmu->named("output"))
    EXPECT_NEAR(parts.get(signal), whole.get(signal), 1e-8 * std::abs(whole.get(signal))) << signal;
}

TEST(Fmu, ErrorOfACouplingFallsWithTheStepOfCommunicationAndItsSquare)
{
  const Folder folder("fmu_coupled");
  ASSERT_EQ(gestell("run " + folder.file("both.toml", both) + folder.option()).exit_code, 0);
  const std::string json = read(folder.results() / "summary.json");
  const double   x1 = json_number(json, {"signals", "x1", "final"}), x2 = json_number(json, {"signals", "x2", "final"});
  const Exported first(folder, "first", folder.file("first.toml", oscillator("first", 2., 800., 0.01)));
  const Exported second(folder, "second", folder.file("second.toml", oscillator("second", 3., 500., 0.)));
  for (const auto &[how, order] : {std::pair{Between::held, 1.}, std::pair{Between::extrapolated, 2.}})
  {
    const double coarse = coupling_error(*first.fmu, *second.fmu, 2e-3, how, x1, x2);
    const double fine   = coupling_error(*first.fmu, *second.fmu, 1e-3, how, x1, x2);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.15) << coarse << " " << fine;
    EXPECT_LT(fine, how == Between::held ? 3e-4 : 1e-5);
  }
}

TEST(Fmu, GoesOnFromAStateAsItDidBefore)
{
  const Folder   folder("fmu_state");
  const Exported press(folder, "press", scene("press_minimal.toml"), "--inputs F=slide");
  FmuInstance    one(*press.fmu, "one"), other(*press.fmu, "other");
  ASSERT_EQ(one.start(), fmi2OK);
  EXPECT_EQ(one.set("F", 500.), fmi2OK);
  EXPECT_EQ(one.step(0., 0.1), fmi2OK);
  fmi2FMUstate      kept = one.keep(), copied = nullptr;
  const std::string bytes   = one.bytes(kept);
  const auto        goes_on = [](const FmuInstance &from)
  {
    std::vector<double> values;
    for (int i = 0; i < 100; ++i) // through the cutting shock
    {
      EXPECT_EQ(from.step(0.1 + i * 3e-3, 3e-3), fmi2OK) << from.last_message();
      for (const char *signal : {"F_P", "x3", "phi2", "M_T"})
        values.push_back(from.get(signal));
    }
    return values;
  };
  const auto at_first = goes_on(one);
  EXPECT_EQ(one.back_to(kept), fmi2OK) << one.last_message();
  EXPECT_EQ(one.get("F"), 500.);
  const auto again = goes_on(one);
  ASSERT_EQ(other.from_bytes(bytes, copied), fmi2OK) << other.last_message();
  EXPECT_EQ(other.back_to(copied), fmi2OK) << other.last_message();
  const auto elsewhere = goes_on(other);
  for (std::size_t i = 0; i < at_first.size(); ++i)
  {
    const double size = std::abs(at_first[i]) + 1e-6; // Newton's error: its scale is that of the motion seen so far
    EXPECT_NEAR(again[i], at_first[i], 1e-6 * size) << i;
    EXPECT_NEAR(elsewhere[i], at_first[i], 1e-6 * size) << i;
  }
  one.forget(kept);
  other.forget(copied);
}

TEST(Fmu, TakesParametersAndInputsOfItsOwnPerInstance)
{
  const Folder   folder("fmu_instances");
  const Exported slider(folder, "slider", folder.file("one.toml", oscillator("one", 2., 800., 0.)));
  FmuInstance    soft(*slider.fmu, "soft"), hard(*slider.fmu, "hard");
  ASSERT_EQ(soft.start({{"F", 8.}}), fmi2OK);
  ASSERT_EQ(hard.start({{"F", 8.}, {"c", 3200.}}), fmi2OK);
  // Over a small part of the period: x = F/c (1 - cos(w t)), w^2 = c/m, less what the damper takes.
  const double t = 0.05;
  EXPECT_EQ(soft.step(0., t), fmi2OK);
  EXPECT_EQ(hard.step(0., t), fmi2OK);
  for (const auto &[instance, c] : {std::pair{&soft, 800.}, std::pair{&hard, 3200.}})
  {
    const double m = 2., delta = 2. / (2. * m), w = std::sqrt(c / m - delta * delta);
    const double x = 8. / c * (1. - std::exp(-delta * t) * (std::cos(w * t) + delta / w * std::sin(w * t)));
    EXPECT_NEAR(instance->get("x"), x, 1e-5 * std::abs(x)); // w h = 2e-3: (w h)^2/12 of the phase
  }
  EXPECT_EQ(hard.reset(), fmi2OK);
  EXPECT_EQ(hard.get("c"), 800.);
  ASSERT_EQ(hard.start({{"F", 8.}}), fmi2OK);
  EXPECT_EQ(hard.step(0., t), fmi2OK);
  EXPECT_EQ(hard.get("x"), soft.get("x"));
}

TEST(Fmu, TellsAnInputWhereItsRateHasBroughtIt)
{
  const Folder   folder("fmu_rate");
  const Exported slider(folder, "slider", folder.file("one.toml", oscillator("one", 2., 800., 0.)));
  FmuInstance    one(*slider.fmu, "one");
  ASSERT_EQ(one.start({{"F", 8.}}), fmi2OK);
  EXPECT_EQ(one.step(0., 0.02), fmi2OK);
  EXPECT_EQ(one.set("F", 3.), fmi2OK);
  EXPECT_EQ(one.set_rate("F", 100.), fmi2OK);
  EXPECT_EQ(one.step(0.02, 0.01), fmi2OK);
  EXPECT_NEAR(one.get("F"), 4., 1e-12); // 3 N + 100 N/s 10 ms
}

TEST(Fmu, ASpeedDriveFollowsTheSpeedThatIsSet)
{
  const Folder      folder("fmu_drive");
  const std::string text = "[body.shaft]\ntype = \"rotor\"\naxis = [0, 1, 0]\ninertia = \"2 kg m^2\"\n"
                           "[element.drive]\ntype = \"speed drive\"\non = \"shaft\"\n"
                           "proportional_gain = \"100 N m s/rad\"\nspeed = \"3 rad/s\"\n"
                           "[start]\nrule = \"given\"\nv = { shaft = \"3 rad/s\" }\n"
                           "[run]\nmethod = \"bdf\"\nstep = \"0.1 ms\"\nend = \"1 s\"\n"
                           "[output.signals]\nw = \"shaft.speed\"\nwanted = \"drive.wanted_speed\"\n";
  const Exported    drive(folder, "drive", folder.file("drive.toml", text), "--inputs drive.speed");
  FmuInstance       one(*drive.fmu);
  ASSERT_EQ(one.start(), fmi2OK) << one.last_message();
  EXPECT_EQ(one.get("drive.speed"), 3.); // what the scene says
  EXPECT_EQ(one.step(0., 0.05), fmi2OK);
  EXPECT_NEAR(one.get("w"), 3., 1e-9);
  EXPECT_EQ(one.set("drive.speed", 5.), fmi2OK);
  EXPECT_EQ(one.step(0.05, 0.04), fmi2OK);
  // J w' = k (w_r - w): two time constants J/k = 20 ms; h k/J = 5e-3, second order.
  EXPECT_NEAR(one.get("w"), 5. - 2. * std::exp(-2.), 1e-5);
  EXPECT_EQ(one.get("wanted"), 5.);
  EXPECT_EQ(one.set_rate("drive.speed", 10.), fmi2OK);
  EXPECT_EQ(one.step(0.09, 0.2), fmi2OK);
  EXPECT_NEAR(one.get("wanted"), 7., 1e-12);
  // Behind a ramp of 10 rad/s^2 it lags by 10 J/k once the start has faded, exp(-10) of a half.
  EXPECT_NEAR(one.get("w"), 7. - 10. * 0.02, 1e-4);
}

TEST(Fmu, EndsWhereASwitchEndsTheRun)
{
  const Folder folder("fmu_end");
  std::string  text = oscillator("one", 2., 800., 0.);
  text += "[switch.far]\nwhen = \"mass.displacement\"\nabove = \"5 mm\"\nends = \"it is far\"\n";
  const Exported slider(folder, "slider", folder.file("one.toml", text));
  FmuInstance    one(*slider.fmu);
  ASSERT_EQ(one.start({{"F", 8.}}), fmi2OK);
  double t = 0.;
  for (; t < 0.2 && one.step(t, 1e-2) == fmi2OK; t += 1e-2)
    ;
  EXPECT_TRUE(one.has_ended());
  EXPECT_NEAR(one.get("x"), 5e-3, 1e-8);
  EXPECT_GT(one.last_time(), t);
  EXPECT_LT(one.last_time(), t + 1e-2);

  // The end is part of its state, here and in another instance, and one from before leads out of it.
  FmuInstance  other(*slider.fmu, "other");
  const double ended = one.last_time(), x = one.get("x");
  fmi2FMUstate kept = one.keep(), copied = nullptr;
  ASSERT_EQ(other.from_bytes(one.bytes(kept), copied), fmi2OK) << other.last_message();
  EXPECT_EQ(one.back_to(kept), fmi2OK);
  EXPECT_EQ(other.back_to(copied), fmi2OK) << other.last_message();
  for (const FmuInstance *instance : {&one, &other})
  {
    EXPECT_TRUE(instance->has_ended());
    EXPECT_EQ(instance->step(ended, 1e-2), fmi2Error);
    EXPECT_THAT(instance->last_message(), testing::HasSubstr("it is far"));
    EXPECT_EQ(instance->last_time(), ended);
    EXPECT_EQ(instance->get("x"), x);
  }
  EXPECT_EQ(one.reset(), fmi2OK);
  EXPECT_FALSE(one.has_ended());
  one.forget(kept);
  other.forget(copied);
}

TEST(Fmu, EndsAlikeWhereEventsAreSkipped)
{
  const Folder folder("fmu_end_over");
  std::string  text = oscillator("one", 2., 800., 0.);
  text += "[switch.far]\nwhen = \"mass.displacement\"\nabove = \"5 mm\"\nends = \"it is far\"\n";
  const Exported slider(folder, "slider", folder.file("one.toml", text), "--set run.events=false");
  FmuInstance    one(*slider.fmu);
  ASSERT_EQ(one.start({{"F", 8.}}), fmi2OK);
  double t = 0., before = 0.;
  for (fmi2Status status = fmi2OK; status == fmi2OK && t < 0.2; t += 2e-5) // within the step of 0.05 ms
  {
    status = one.step(t, 2e-5);
    EXPECT_GE(one.last_time(), before);
    before = one.last_time();
  }
  EXPECT_TRUE(one.has_ended());
  EXPECT_NEAR(one.get("x"), 5e-3, 1e-8); // its crossing is drawn straight within a step: x'' h^2/8 = 1e-9 m
}

TEST(Fmu, AStateKnowsItsFmuAndItsStopTime)
{
  const Folder   folder("fmu_own_states");
  const Exported first(folder, "first", folder.file("first.toml", oscillator("first", 2., 800., 0.)));
  const Exported second(folder, "second", folder.file("second.toml", oscillator("second", 2., 900., 0.)));
  FmuInstance    one(*first.fmu), other(*second.fmu);
  ASSERT_EQ(one.start({}, 0., 5e-3), fmi2OK);
  ASSERT_EQ(other.start(), fmi2OK);
  EXPECT_EQ(one.step(0., 4e-3), fmi2OK);
  EXPECT_EQ(other.step(0., 1e-3), fmi2OK);
  fmi2FMUstate      kept = one.keep(), foreign = nullptr;
  const std::string bytes = one.bytes(kept);
  EXPECT_EQ(other.from_bytes(bytes, foreign), fmi2OK);
  EXPECT_EQ(other.back_to(foreign), fmi2Error);
  EXPECT_THAT(other.last_message(), testing::HasSubstr("the state is that of another FMU"));
  EXPECT_EQ(other.step(1e-3, 1e-3), fmi2OK) << other.last_message(); // nothing has happened to it
  EXPECT_EQ(other.get("c"), 900.);

  EXPECT_EQ(one.reset(), fmi2OK);
  EXPECT_EQ(one.back_to(kept), fmi2OK) << one.last_message();
  EXPECT_EQ(one.step(4e-3, 4e-3), fmi2Error);
  EXPECT_THAT(one.last_message(), testing::HasSubstr("beyond the stop time 0.005 s"));
  EXPECT_EQ(one.step(4e-3, 1e-3), fmi2OK);

  // The motion begins with its time.
  fmi2FMUstate      damaged = nullptr;
  const double      nan = std::nan(""), t = 4e-3;
  const std::string time(reinterpret_cast<const char *>(&t), sizeof t);
  std::string       broken = bytes;
  const auto        at     = broken.rfind(time);
  ASSERT_NE(at, std::string::npos);
  broken.replace(at, sizeof nan, reinterpret_cast<const char *>(&nan), sizeof nan);
  EXPECT_EQ(one.from_bytes(broken, damaged), fmi2Error);
  EXPECT_THAT(one.last_message(), testing::HasSubstr("not finite"));
  EXPECT_EQ(one.from_bytes(bytes.substr(0, bytes.size() - 4), damaged), fmi2Error);
  EXPECT_THAT(one.last_message(), testing::HasSubstr("not a state of an FMU"));
  one.forget(kept);
  other.forget(foreign);
}

TEST(Fmu, NoValueThatIsNotFiniteIsWithinABound)
{
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(share_of_difference(3., 1., 4.), 0.5);
  EXPECT_EQ(share_of_difference(2., 2., 0.), 0.);
  EXPECT_EQ(share_of_difference(0., 0., 0.), 0.);
  EXPECT_EQ(share_of_difference(2., 1., 0.), 0.5);
  for (const double odd : {nan, infinity})
  {
    EXPECT_EQ(share_of_difference(odd, 1., 1.), infinity);
    EXPECT_EQ(share_of_difference(1., odd, 1.), infinity);
    EXPECT_EQ(share_of_difference(1., 1., odd), infinity);
  }
}

} // namespace gestell::tests
