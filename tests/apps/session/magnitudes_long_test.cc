// All typical mistakes of magnitude by runs, and the runs of all scenes; those with a mesh where meshes can be made.

#include "tests/apps/session/magnitude_cases.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A key of the mistake, its value and the expected range, in one warning; or a refusal that names the key.
TEST(TypicalMistakes, AreMostlyAnswered)
{
  std::vector<std::string> silent;
  for (const TypicalMistake &mistake : typical_mistakes())
  {
    const auto answer = answer_to(mistake, mistake.command == "run");
    EXPECT_LE(magnitudes_of(answer).size(), 1u) << mistake.line << '\n' << testing::PrintToString(answer);
    if (is_answered(mistake, answer))
      continue;
    silent.push_back(mistake.line);
    std::cout << "silent: " << mistake.line << '\n';
    for (const std::string &sentence : answer)
      std::cout << "        " << sentence << '\n';
  }
  EXPECT_LE(silent.size(), 20u);
}

#ifdef GESTELL_MESHES
constexpr bool meshes = true;
#else
constexpr bool meshes = false;
#endif

class RunOfAScene : public testing::TestWithParam<std::string>
{
};

TEST_P(RunOfAScene, HasNoUnexpectedValue)
{
  const auto sentences = sentences_of(GetParam(), {}, meshes || !needs_mesh(GetParam()));
  EXPECT_THAT(magnitudes_of(sentences), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, RunOfAScene, testing::ValuesIn(shipped_scenes()), name_of_scene);

} // namespace
} // namespace gestell::tests
