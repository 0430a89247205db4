// Folders for temporary files: new, of this user alone, gone with their owner.

#include "fem/values/temporary_directory.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace gestell::tests
{

namespace fs = std::filesystem;

TEST(TemporaryDirectory, IsNewAndOfItsUserAloneAndGoesWithItsOwner)
{
  fs::path first;
  {
    const fem::TemporaryDirectory one, other;
    first = one.path();
    EXPECT_NE(one.path(), other.path()); // of one process: no name can be foreseen
    EXPECT_TRUE(fs::is_empty(first));
    EXPECT_EQ(fs::status(first).permissions(), fs::perms::owner_all);
    fs::create_directory(first / "inner");
    std::ofstream(first / "inner" / "file") << "text";
  }
  EXPECT_FALSE(fs::exists(first));
}

TEST(TemporaryDirectory, ThatHasNoPlaceIsToldWithTheVariableThatSaysWhere)
{
  const char       *there  = std::getenv("TMPDIR");
  const std::string before = there ? there : "";
  setenv("TMPDIR", "/dev/null", 1);
  std::string reported;
  try
  {
    const fem::TemporaryDirectory folder;
  }
  catch (const std::runtime_error &failure)
  {
    reported = failure.what();
  }
  EXPECT_EQ(fem::words_of_removal(), "");
  there ? setenv("TMPDIR", before.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_NE(reported.find("TMPDIR says where they go"), std::string::npos) << reported;
}

} // namespace gestell::tests
