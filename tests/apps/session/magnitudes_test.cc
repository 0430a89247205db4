// Warnings of values that machines hardly have: typical mistakes lead to one, the scenes that are shipped to none.

#include "tests/apps/session/magnitude_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

/// A rod a thousand times too soft is seen by its damping before the run, and by its compression after it.
TEST(Magnitudes, NameValueRangeAndKey)
{
  const std::string text = text_of(magnitudes_of(sentences_of("press_minimal.toml", {"parameters.c_P=900 N/m"}, true)));
  EXPECT_THAT(text, HasSubstr("press_minimal.toml:"));
  EXPECT_THAT(text, HasSubstr("element.rod.damping: with the stiffness and the masses gives a damping ratio of "));
  EXPECT_THAT(text, HasSubstr("element.rod.stiffness: yields by "));
  EXPECT_THAT(text, HasSubstr("; expected: at most "));
}

TEST(Magnitudes, OfAMotorAreItsSlipAndTheTimeToStart)
{
  EXPECT_THAT(text_of(sentences_of("double_four_bar.toml", {"element.motor.ratio=0.04"}, false)),
              HasSubstr("element.motor.breakdown_torque: with ratio 0.04 accelerates the 6 kg m^2 of its shaft to the "
                        "synchronous speed within "));
  EXPECT_THAT(text_of(sentences_of("crank_press_joints.toml", {"element.motor.ratio=0.5"}, true)),
              HasSubstr("element.motor.slip: at the start of the run is "));
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
  int caught = 0;
  for (const TypicalMistake &mistake : mistakes)
    caught += is_caught(mistake, false) ? 1 : 0;
  EXPECT_GE(caught, 36);
}

} // namespace
} // namespace gestell::tests
