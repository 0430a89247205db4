// Fixed steps do not see what happens between their ends: a warning says so where forces change too fast, and only
// there.

#include "apps/session/session.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using testing::HasSubstr;
using testing::Not;

std::string joined(const std::vector<std::string> &texts)
{
  std::string all;
  for (const std::string &text : texts)
    all += text + "\n";
  return all;
}

std::string warnings_of(const std::string &text)
{
  const test::SceneFolder folder;
  return joined(coupling::texts_of(apps::Session(folder.write("scene.toml", text)).run().run->findings));
}

std::string run_at(const std::string &step, const std::string &method = "bdf")
{
  return test::quoted("[output.signals]\nx = 'slide.displacement'\n[run]\nmethod = '" + method +
                      "'\nend = '0.2 s'\nstep = '" + step + "'\n");
}

/// 30 1/s, with a push of its own kind.
std::string pushed(const std::string &type, const std::string &law)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1000"}, {"damping", "1"}}) +
         element("push", type, {{"from", "slide"}}) + test::quoted(law + "\n");
}

std::string harmonic(const std::string &frequency)
{
  return pushed("force", "direction = [1, 0, 0]\nharmonics = [{ amplitude = '10 N', frequency = '" + frequency +
                             "', phase = '90 deg' }]");
}

} // namespace

TEST(StepResolutionCheck, OfAHarmonicLoadBelowTwoStepsAPeriodAreRefused)
{
  for (const char *method : {"bdf", "newmark", "generalised-alpha"})
    for (const char *frequency : {"500 Hz", "965 Hz", "995 Hz", "1000 Hz", "3 kHz"})
    {
      SCOPED_TRACE(std::string(method) + ", " + frequency);
      expect_refusal([&] { warnings_of(harmonic(frequency) + run_at("1 ms", method)); }, "too short for this step");
    }
  EXPECT_THAT(warnings_of(harmonic("965 Hz") + run_at("1 ms", "exact")),
              Not(HasSubstr("run.step: "))); // carried exactly
}

TEST(StepResolutionCheck, AreReportedBelowTenStepsAPeriodOfALoad)
{
  EXPECT_THAT(warnings_of(harmonic("125 Hz") + run_at("1 ms")), HasSubstr("8 steps in a period of the load of 125 Hz"));
  EXPECT_THAT(warnings_of(harmonic("50 Hz") + run_at("1 ms")), Not(HasSubstr("run.step")));
}

TEST(StepResolutionCheck, OfFormulasAndProfilesAreReportedHoweverTheyMeetTheSteps)
{
  const auto formula = [](const std::string &frequency)
  { return pushed("formula force", "force = '10 N*cos(2*pi*" + frequency + "*t)'"); };
  for (const char *frequency : {"125 Hz", "250 Hz", "500 Hz", "965 Hz", "1000 Hz", "3000 Hz"})
    EXPECT_THAT(warnings_of(formula(frequency) + run_at("1 ms")), HasSubstr("the force of push")) << frequency;
  for (const char *frequency : {"5 Hz", "50 Hz", "80 Hz"})
    EXPECT_THAT(warnings_of(formula(frequency) + run_at("1 ms")), Not(HasSubstr("run.step"))) << frequency;
  const auto profile = [](const std::string &half, const std::string &whole)
  {
    return pushed("force profile", "profile = { table = [['0 s', '10 N'], ['" + half + "', '-10 N'], ['" + whole +
                                       "', '10 N']], period = '" + whole + "' }");
  };
  EXPECT_THAT(warnings_of(profile("0.5 ms", "1 ms") + run_at("1 ms")), HasSubstr("the force of push"));
  EXPECT_THAT(warnings_of(profile("50 ms", "100 ms") + run_at("1 ms")), Not(HasSubstr("run.step")));
}

TEST(StepResolutionCheck, OfAPulseWithinAStepAreReportedAndAStepOfForceIsNot)
{
  const auto pulse = [](const std::string &width)
  { return pushed("formula force", "force = '1e4 N*exp(-((t-0.1005 s)/(" + width + "))^2)'"); };
  EXPECT_THAT(warnings_of(pulse("0.03 ms") + run_at("1 ms")), HasSubstr("between the ends of steps"));
  EXPECT_THAT(warnings_of(pulse("20 ms") + run_at("1 ms")), Not(HasSubstr("run.step")));
  EXPECT_THAT(warnings_of(pushed("force profile", "profile = { table = [['0 s', 0], ['0.1 s', 0], ['0.1001 s', "
                                                  "'10 N'], ['0.2 s', '10 N']] }") +
                          run_at("1 ms")),
              Not(HasSubstr("run.step")));
}

TEST(StepResolutionCheck, OfAnUnbalanceThatTurnsByAWholeTurnInAStepAreReported)
{
  const auto turning = [](const std::string &speed)
  {
    return test::quoted("[body.slide]\ntype = 'slider'\naxis = [1, 0, 0]\nmass = 10\n"
                        "[body.disc]\ntype = 'rotor'\non = 'slide'\naxis = [0, 1, 0]\ninertia = 0.01\n"
                        "unbalance = '1 g m'\n[start]\nv = { disc = '" +
                        speed + "' }\n") +
           element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "10000"}, {"damping", "5"}});
  };
  EXPECT_THAT(warnings_of(turning("6283.185307179586 rad/s") + run_at("1 ms")),
              HasSubstr("'disc' rotates by 360 degrees"));
  EXPECT_THAT(warnings_of(turning("60 rad/s") + run_at("1 ms")), Not(HasSubstr("run.step")));
}

} // namespace gestell::tests
