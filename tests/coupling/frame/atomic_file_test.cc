#include "coupling/frame/atomic_file.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utime.h>

namespace gestell
{
namespace
{
namespace fs = std::filesystem;

class AtomicFile : public ::testing::Test
{
protected:
  AtomicFile() { fs::create_directories(folder); }
  ~AtomicFile() override { fs::remove_all(folder); }

  std::string content() const
  {
    std::ifstream      file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  auto files() const { return std::distance(fs::directory_iterator(folder), {}); }

  fs::path    folder = fs::temp_directory_path() / ("gestell-whole-file-" + std::to_string(getpid()));
  std::string path   = (folder / "history.csv").string();
};

TEST_F(AtomicFile, IsNotThereBeforeItIsFinished)
{
  {
    coupling::AtomicFile file(path);
    file.stream() << "new" << std::flush;
    EXPECT_FALSE(fs::exists(path));
    file.finish();
    EXPECT_EQ(content(), "new");
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
  EXPECT_EQ(content(), "old");
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
    const std::string message = tests::refusal<std::runtime_error>(
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
  EXPECT_EQ(content(), "old");
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

} // namespace
} // namespace gestell
