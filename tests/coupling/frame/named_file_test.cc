// Names under which the file system finds something, finds nothing, or does not say.

#include "fem/values/named_file.h"
#include "fem/values/temporary_directory.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace gestell::tests
{

namespace fs = std::filesystem;

TEST(NamedFile, IsThereOrNotWhereTheFileSystemSaysSo)
{
  const fem::TemporaryDirectory folder;
  const fs::path                file = folder.path() / "file";
  std::ofstream(file) << "text";
  fs::create_symlink("file", folder.path() / "link");
  fs::create_symlink("nothing", folder.path() / "dangling");
  for (const fs::path &name : {file, folder.path(), folder.path() / "link"})
  {
    EXPECT_EQ(fem::why_unreachable(name), "") << name;
    EXPECT_TRUE(fem::names_something(name)) << name;
  }
  for (const fs::path &name : {folder.path() / "other", folder.path() / "dangling", file / "below", fs::path()})
  {
    EXPECT_EQ(fem::why_unreachable(name), "") << name;
    EXPECT_FALSE(fem::names_something(name)) << name;
  }
}

void expect_unreachable(const fs::path &name, const std::string &reason)
{
  EXPECT_NE(fem::why_unreachable(name).find("(" + reason + ")"), std::string::npos) << fem::why_unreachable(name);
  EXPECT_THROW(fem::names_something(name), std::invalid_argument) << name;
}

TEST(NamedFile, IsToldWhereTheFileSystemDoesNotSay)
{
  const fem::TemporaryDirectory folder;
  fs::create_symlink("ring", folder.path() / "ring");
  expect_unreachable(folder.path() / std::string(300, 'x'), "File name too long");
  expect_unreachable(folder.path() / "ring", "Too many levels of symbolic links");
  expect_unreachable(folder.path() / "ring" / "below", "Too many levels of symbolic links");
  fs::create_directory(folder.path() / "closed");
  fs::permissions(folder.path() / "closed", fs::perms::none);
  if (geteuid() != 0) // who may enter any folder
    expect_unreachable(folder.path() / "closed" / "file", "Permission denied");
  fs::permissions(folder.path() / "closed", fs::perms::owner_all);
}

} // namespace gestell::tests
