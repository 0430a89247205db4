// Sizes that are asked for are judged before memory is taken, and what takes the cube of the coordinates is left out of
// runs that take much less.

#include "fem/values/available_memory.h"
#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/limited_memory.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::apps
{
namespace
{

using testing::HasSubstr;

/// Sliders in a row between springs; a run of ten steps.
std::string row_of_sliders(int n, const std::string &more = "")
{
  std::string text = "name = \"row\"\n[run]\nmethod = \"newmark\"\nstep = \"1 ms\"\nend = \"10 ms\"\n"
                     "[start]\nq = { m0 = \"1 mm\" }\n[output]\nsignals = [\"m0.displacement\"]\n" +
                     more;
  for (int i = 0; i < n; ++i)
  {
    const std::string own = std::to_string(i), from = i == 0 ? "ground" : "m" + std::to_string(i - 1);
    text += "[body.m" + own + "]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = 1\n[element.s" + own +
            "]\ntype = \"spring-damper\"\nfrom = \"" + from + "\"\nto = \"m" + own +
            "\"\ndirection = [1, 0, 0]\nstiffness = 1e4\n";
  }
  return text;
}

Session session_of(const std::string &text, const std::vector<std::string> &overrides = {})
{
  return Session({}, test::scene_of(text, overrides), {});
}

} // namespace

TEST(Sizes, AnswerSaysWhatWouldBeTakenWhatThereIsAndTheWayOut)
{
  const std::string message = tests::refusal([] { fem::require_available("a thing", 1e18, "Ask for a smaller one."); });
  EXPECT_THAT(message, HasSubstr("a thing would take 9.3132e+08 GiB of memory; available are "));
  EXPECT_THAT(message, HasSubstr("Ask for a smaller one."));
  EXPECT_NO_THROW(fem::require_available("a thing", 1e3, ""));
}

TEST(Sizes, ALimitOfTheProcessIsAvailableMemory)
{
  const tests::LimitedMemory limited(std::size_t(64) << 20);
  EXPECT_LT(fem::available_memory(), 80e6);
}

TEST(Sizes, ModesOfALargeMachineAreLeftOutOfARunAndReportedSo)
{
  Session      session = session_of(row_of_sliders(601));
  const Result result  = session.run();
  EXPECT_TRUE(result.run->failure.empty()) << result.run->failure;
  EXPECT_TRUE(result.coupled_modes.empty());
  EXPECT_THAT(result.warnings, testing::Contains(HasSubstr("with 601 DOFs")));
}

TEST(Sizes, ModesAreOmittedWhereNoneAreAskedFor)
{
  Session      session = session_of(row_of_sliders(3), {"modes.number=0"});
  const Result result  = session.run();
  EXPECT_TRUE(result.run->failure.empty()) << result.run->failure;
  EXPECT_TRUE(result.coupled_modes.empty());
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_THAT(tests::refusal([] { session_of(row_of_sliders(3), {"modes.number=0"}).modes(); }),
              HasSubstr("modes.number = 0"));
}

TEST(Sizes, OfRowsThatArePermittedAreJudgedByTheMemory)
{
  Session session = session_of(row_of_sliders(2, "step = \"1e-13 ms\"\nallow_large = true\n"));
  EXPECT_THAT(tests::refusal([&] { session.run(); }), HasSubstr("output.step"));
}

TEST(Sizes, OfHarmonicsAreLimited)
{
  PeriodicRequest request{"harmonic-balance"};
  request.own["harmonics"] = 1000000000;
  EXPECT_THAT(tests::refusal([&] { tests::periodic_of(tests::duffing(0.05, 0.1, 0.2, 1.2), request); }),
              HasSubstr("--harmonics is 1000000000"));
}

} // namespace gestell::apps
