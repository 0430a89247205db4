// Warnings of values that machines hardly have: typical mistakes lead to one, the scenes that are shipped to none.

#include "tests/apps/session/magnitude_cases.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using testing::HasSubstr;

std::string text_of(const std::vector<std::string> &sentences)
{
  std::string text;
  for (const std::string &sentence : sentences)
    text += sentence + '\n';
  return text;
}

class ShippedScene : public testing::TestWithParam<std::string>
{
};

TEST_P(ShippedScene, HasNoUnexpectedValue)
{
  EXPECT_THAT(magnitudes_of(sentences_of(GetParam(), {}, false)), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped_scenes()), name_of_scene);

TEST(Magnitudes, OfCheapRunsAreThoseOfMachines)
{
  for (const char *scene : {"press_minimal.toml", "double_four_bar.toml", "run_up.toml"})
    EXPECT_THAT(magnitudes_of(sentences_of(scene, {}, true)), testing::IsEmpty()) << scene;
}

/// A rod a million times too soft is seen by its damping before the run; its compression after it is named there.
TEST(Magnitudes, NameValueRangeAndKeyInOneWarning)
{
  const auto found = magnitudes_of(sentences_of("press_minimal.toml", {"parameters.c_P=900 N/m"}, true));
  ASSERT_EQ(found.size(), 1u) << text_of(found);
  EXPECT_THAT(found[0], HasSubstr("press_minimal.toml:"));
  EXPECT_THAT(found[0],
              HasSubstr("element.rod.damping: with the stiffness and the masses gives a damping ratio of 78.35"));
  EXPECT_THAT(found[0], HasSubstr("; expected: at most 10"));
  EXPECT_THAT(found[0], HasSubstr("; also unexpected, perhaps for the same reason: "));
  EXPECT_THAT(found[0], HasSubstr("element.rod.stiffness"));
}

/// Of what one stage finds, the value farthest out of its range.
TEST(Magnitudes, OfOneMistakeAreNamedByTheMostTelling)
{
  const std::vector<apps::UnexpectedValue> found = {{"a.toml:3: element.a.damping", "is 3; expected: at most 2", 1.5},
                                                    {"a.toml:5: body.b", "is 40; expected: at most 2", 20.},
                                                    {"a.toml:3: element.a.damping", "is 5; expected: at most 4", 1.2}};
  std::vector<std::string>                 warnings = {"something else"};
  apps::warn_of_magnitudes(found, warnings);
  ASSERT_EQ(warnings.size(), 2u);
  const std::string first = "a.toml:5: body.b: is 40; expected: at most 2; also unexpected, perhaps for the same "
                            "reason: element.a.damping";
  EXPECT_EQ(warnings[1], first);
  apps::warn_of_magnitudes({{"body.b", "moves 3 m; expected: at most 2 m", 3.}}, warnings); // it is named already
  EXPECT_EQ(warnings[1], first);
  apps::warn_of_magnitudes({}, warnings);
  EXPECT_EQ(warnings.size(), 2u);
}

TEST(Magnitudes, OfAMotorAreItsSlipAndTheTimeToStart)
{
  EXPECT_THAT(text_of(sentences_of("double_four_bar.toml", {"element.motor.ratio=0.04"}, false)),
              HasSubstr("element.motor.breakdown_torque: with --set element.motor.ratio=0.04: with ratio 0.04 "
                        "accelerates the 6 kg m^2 of its shaft to the "
                        "synchronous speed within "));
  EXPECT_THAT(text_of(sentences_of("crank_press_joints.toml", {"element.motor.ratio=0.5"}, true)),
              HasSubstr("element.motor.slip: with --set element.motor.ratio=0.5: at the start of the run is "));
}

/// Of the two, the slower machine only needs longer.
TEST(Magnitudes, OfAMotorThatIsStillStartingAreRight)
{
  EXPECT_THAT(magnitudes_of(sentences_of("double_four_bar.toml", {"run.end=0.3 s"}, true)), testing::IsEmpty());
}

/// Of the mistakes that can be seen before a run at least half: it costs nothing there.
TEST(Magnitudes, OfManyTypicalMistakesAreSeenBeforeTheRun)
{
  const auto mistakes = typical_mistakes();
  ASSERT_EQ(mistakes.size(), 72u);
  const auto caught =
      std::count_if(mistakes.begin(), mistakes.end(),
                    [](const TypicalMistake &mistake) { return is_answered(mistake, answer_to(mistake, false)); });
  EXPECT_GE(caught, 36);
}

} // namespace
} // namespace gestell::tests
