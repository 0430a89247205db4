// Meshes and geometry at random: whatever stands in a file, it is taken with a sound mesh or refused by a message.

#include "fem/values/temporary_directory.h"
#include "tests/fuzz/mesh/mesh_fuzz.h"
#include "tests/support/test.h"

namespace gestell::fuzz
{
namespace
{

namespace files = std::filesystem;

constexpr std::uint64_t n_executions = 16; ///< of a target

using Meshes = ::testing::TestWithParam<std::string>;

TEST_P(Meshes, OfSeedsAreSound)
{
  const MeshTarget &target = mesh_target(GetParam());
  EXPECT_FALSE(target.seeds.empty());
  const fem::TemporaryDirectory own; // others do the same at the same time
  const files::path             folder  = own.path();
  std::size_t                   n_sound = 0; // a script may draw what one number asks of it and no other
  std::string                   last;
  for (const std::string &seed : target.seeds)
  {
    int n_taken = 0; // of one body or of two, as the number asks
    for (std::uint64_t number = 0; number < 4; ++number)
    {
      const Judgement judgement = judge(write_file(target, seed, folder), number);
      n_taken += judgement.outcome == Outcome::taken;
      if (judgement.outcome != Outcome::taken)
        last = judgement.words;
    }
    n_sound += n_taken > 0;
  }
  EXPECT_GE(2 * n_sound, target.seeds.size()) << last;
}

TEST_P(Meshes, AtRandomAreTakenOrRefused)
{
  const Tally tally = fuzz(mesh_target(GetParam()), 0, n_executions);
  for (const auto &[number, words] : tally.findings)
    ADD_FAILURE() << GetParam() << ' ' << number << ": " << words;
  EXPECT_EQ(tally.executions, n_executions);
  RecordProperty("tally", tally.text());
}

INSTANTIATE_TEST_SUITE_P(Of, Meshes, ::testing::ValuesIn(mesh_target_names()),
                         [](const auto &info) { return info.param; });

/// Files of the past that gmsh died of, or never ended.
TEST(Meshes, FoundOnceAreRefused)
{
  std::vector<files::path> found;
  for (const auto &entry : files::directory_iterator(GESTELL_SOURCE_DIR "/tests/fuzz/mesh/found"))
    found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  EXPECT_FALSE(found.empty());
  for (const files::path &file : found)
  {
    const std::string name      = file.filename().string();
    const bool        part      = name.rfind("part_", 0) == 0; // of the mechanism: 1, else of a frame: 0
    const Judgement   judgement = judge_alone(file, part, 1);
    const bool        endless   = name.rfind("without_end", 0) == 0; // in meshing, where Ctrl-C ends it
    EXPECT_TRUE(judgement.outcome == Outcome::refused || (endless && judgement.outcome == Outcome::long_))
        << file << ": " << judgement.words;
  }
}

} // namespace
} // namespace gestell::fuzz
