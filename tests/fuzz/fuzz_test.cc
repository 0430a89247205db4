// What people hand over is read or refused by a message, whatever it is: findings of the past, and some thousand
// mutations of sound files.  Millions of them, led by what the reader does, are tests/fuzz/run's.

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"
#include "tests/support/test.h"

#include <exception>

namespace gestell::fuzz
{
namespace
{

constexpr unsigned n_mutations = 1000; ///< of a target

/// What is found; "" if nothing.
std::string finding(const Target &target, const std::string &bytes)
{
  try
  {
    feed(target, bytes);
    return "";
  }
  catch (const std::exception &broken)
  {
    return broken.what();
  }
}

class Readers : public ::testing::TestWithParam<std::string>
{
protected:
  const Target &own = target(GetParam());
};

TEST_P(Readers, RefuseEveryFindingOfThePastByAMessage)
{
  for (const auto &[name, bytes] : files_in(GESTELL_SOURCE_DIR "/tests/fuzz/findings/" + own.name))
    EXPECT_EQ(finding(own, bytes), "") << "tests/fuzz/findings/" << own.name << "/" << name;
}

TEST_P(Readers, TakeOrRefuseMutationsOfSoundFiles)
{
  const auto seeds = seeds_of(own.name, GESTELL_SOURCE_DIR);
  ASSERT_FALSE(seeds.empty());
  for (unsigned k = 0; k < n_mutations; ++k)
    ASSERT_EQ(finding(own, mutation(seeds, k)), "") << "mutation " << k << " of " << own.name;
}

/// Else the mutations of a seed would be refused at the first look.
TEST_P(Readers, ReadTheirSeeds)
{
  int         n_read = 0;
  std::string last;
  for (const std::string &seed : seeds_of(own.name, GESTELL_SOURCE_DIR))
    try
    {
      own.read(seed);
      ++n_read;
    }
    catch (const std::invalid_argument &refused)
    {
      last = refused.what();
    }
  EXPECT_GT(n_read, 0) << "none of the seeds is sound: " << last;
}

std::vector<std::string> names()
{
  std::vector<std::string> names;
  for (const Target &target : targets())
    names.push_back(target.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(OfAll, Readers, ::testing::ValuesIn(names()), [](const auto &info) { return info.param; });

} // namespace
} // namespace gestell::fuzz
