// Folders for temporary files: new, of this user alone, gone with their owner.

#include "fem/values/passing_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace gestell::tests
{

namespace fs = std::filesystem;

TEST(PassingFolder, IsNewAndOfItsUserAloneAndGoesWithItsOwner)
{
  fs::path first;
  {
    const fem::PassingFolder one, other;
    first = one.path();
    EXPECT_NE(one.path(), other.path()); // of one process: no name can be foreseen
    EXPECT_TRUE(fs::is_empty(first));
    EXPECT_EQ(fs::status(first).permissions(), fs::perms::owner_all);
    fs::create_directory(first / "inner");
    std::ofstream(first / "inner" / "file") << "text";
  }
  EXPECT_FALSE(fs::exists(first));
}

} // namespace gestell::tests
