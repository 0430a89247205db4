#include "apps/output/folder_lock.h"
#include "tests/support/test.h"

#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

/// Another process that takes the lock, is seen to hold it, and writes its name only `delay` later.
class SlowHolder
{
public:
  SlowHolder(const fs::path &file, int delay_ms)
  {
    int taken[2];
    EXPECT_EQ(pipe(taken), 0);
    process_ = fork();
    if (process_ == 0)
      hold(file, delay_ms, taken[1]);
    close(taken[1]);
    char answer = 0;
    EXPECT_EQ(read(taken[0], &answer, 1), 1); // 0: the child ended without the lock
    close(taken[0]);
  }
  ~SlowHolder()
  {
    if (process_ > 0 && kill(process_, SIGKILL) == 0)
      waitpid(process_, nullptr, 0);
  }
  std::string process() const { return std::to_string(process_); }

private:
  [[noreturn]] static void hold(const fs::path &file, int delay_ms, int taken)
  {
    const int    opened = open(file.c_str(), O_CREAT | O_RDWR, 0644);
    struct flock lock   = {};
    lock.l_type         = F_WRLCK;
    if (fcntl(opened, F_SETLK, &lock) != 0 || write(taken, "t", 1) != 1)
      _exit(1);
    usleep(1000 * delay_ms);
    const std::string words = std::to_string(getpid()) + "\ncomputer\nis busy\n";
    if (pwrite(opened, words.data(), words.size(), 0) > 0)
      pause();
    _exit(1);
  }

  pid_t process_ = 0;
};

std::string refusal(const fs::path &folder)
{
  try
  {
    FolderLock lock(folder);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(FolderLock, AHolderThatHasNotWrittenItsNameYetIsNamedAllTheSame)
{
  const fs::path folder = fs::path(testing::TempDir()) / ("lock" + std::to_string(getpid()));
  fs::create_directories(folder);
  {
    const SlowHolder  holder(folder / ".gestell-lock", 20);
    const std::string text = refusal(folder);
    EXPECT_THAT(text, testing::HasSubstr(": process " + holder.process() + " on computer is busy; "));
  }
  {
    std::ofstream(folder / ".gestell-lock") << "1\nelsewhere\nwas busy\n"; // of a dead process
    const SlowHolder  holder(folder / ".gestell-lock", 20);
    const std::string text = refusal(folder);
    EXPECT_THAT(text, testing::HasSubstr(": process " + holder.process() + " on computer is busy; "));
  }
  EXPECT_EQ(refusal(folder), "");
  fs::remove_all(folder);
}

} // namespace gestell::apps
