// Files and folders: whole or not there, found or not, temporary ones gone with their owner.

#include "coupling/frame/atomic_file.h"
#include "fem/values/named_file.h"
#include "fem/values/temporary_directory.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <csignal>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utime.h>

namespace gestell::tests
{
namespace
{
namespace fs = std::filesystem;

class AtomicFile : public ::testing::Test
{
protected:
  auto files() const { return std::distance(fs::directory_iterator(folder / ""), {}); }

  Folder      folder{"whole_file"};
  std::string path = (folder / "history.csv").string();
};

TEST_F(AtomicFile, IsNotThereBeforeItIsFinished)
{
  {
    coupling::AtomicFile file(path);
    file.stream() << "new" << std::flush;
    EXPECT_FALSE(fs::exists(path));
    file.finish();
    EXPECT_EQ(read(path), "new");
  }
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, ThatIsGivenUpLeavesWhatStoodInItsPlace)
{
  std::ofstream(path) << "old";
  {
    coupling::AtomicFile file(path);
    file.stream() << "new" << std::flush;
  }
  EXPECT_EQ(read(path), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, OnAFullDiskIsAnErrorWithPathAndReasonAndLeavesWhatStoodInItsPlace)
{
  std::ofstream(path) << "old";
  const pid_t child = fork(); // whose files may not grow beyond 4096 bytes: what a full disk looks like from inside
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = refusal<std::runtime_error>(
        [&]
        {
          coupling::AtomicFile file(path);
          file.stream() << std::string(1000000, 'x');
          file.finish();
        });
    _exit(message.find(path) == 0 && message.find("too large") != std::string::npos ? 0 : 1);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read(path), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, OfAKilledProcessIsTakenForAbandonedAfterAnHour)
{
  const fs::path being_written = folder / "unfinished-1-2", of_a_user = folder / "unfinished-thesis.txt";
  std::ofstream(being_written) << "x";
  std::ofstream(of_a_user) << "x";
  EXPECT_FALSE(coupling::abandoned(being_written.string()));
  const utimbuf long_ago{1000000000, 1000000000};
  utime(being_written.c_str(), &long_ago);
  utime(of_a_user.c_str(), &long_ago);
  EXPECT_TRUE(coupling::abandoned(being_written.string()));
  EXPECT_FALSE(coupling::abandoned(of_a_user.string()));
}

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

TEST(TemporaryDirectory, ThatHasNoPlaceIsReportedWithTheVariableThatSaysWhere)
{
  const char       *there  = std::getenv("TMPDIR");
  const std::string before = there ? there : "";
  setenv("TMPDIR", "/dev/null", 1);
  const std::string reported = refusal<std::runtime_error>([] { const fem::TemporaryDirectory folder; });
  EXPECT_EQ(fem::words_of_removal(), "");
  there ? setenv("TMPDIR", before.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_NE(reported.find("set TMPDIR to another folder"), std::string::npos) << reported;
}

TEST(NamedFile, IsThereOrNotWhereTheFileSystemSaysSo)
{
  const Folder   folder("named_file");
  const fs::path file = folder / "file";
  std::ofstream(file) << "text";
  fs::create_symlink("file", folder / "link");
  fs::create_symlink("nothing", folder / "dangling");
  for (const fs::path &name : {file, folder / "", folder / "link"})
  {
    EXPECT_EQ(fem::why_unreachable(name), "") << name;
    EXPECT_TRUE(fem::names_something(name)) << name;
  }
  for (const fs::path &name : {folder / "other", folder / "dangling", file / "below", fs::path()})
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

TEST(NamedFile, IsReportedWhereTheFileSystemDoesNotSay)
{
  const Folder folder("named_file");
  fs::create_symlink("ring", folder / "ring");
  expect_unreachable(folder / std::string(300, 'x'), "File name too long");
  expect_unreachable(folder / "ring", "Too many levels of symbolic links");
  expect_unreachable(folder / "ring" / "below", "Too many levels of symbolic links");
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::none);
  if (geteuid() != 0) // who may enter any folder
    expect_unreachable(folder / "closed" / "file", "Permission denied");
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

} // namespace
} // namespace gestell::tests
