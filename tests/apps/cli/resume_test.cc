// A run that was killed goes on from its last checkpoint and leaves what it would have left.

#include "tests/support/program.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

namespace gestell::tests
{
namespace
{

using Json = nlohmann::json;

const std::string press = scene("press_minimal.toml") + " --set run.end=0.9 --set run.step=2e-6 --checkpoint 0.01";

/// Starts the program; its process.
pid_t started(const std::string &arguments)
{
  const pid_t child = fork();
  if (child == 0)
  {
    const std::string command = "GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' exec '" GESTELL_BINARY_DIR
                                "/bin/gestell' " +
                                arguments + " >/dev/null 2>&1";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  return child;
}

bool is_running(pid_t child)
{
  siginfo_t ended = {};
  return waitid(P_PID, child, &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0;
}

/// Sends the signal; the wait status of the process.
int killed(pid_t child, int signal)
{
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

/// But for what the clock tells.
Json summary(const Folder &folder)
{
  Json json = Json::parse(read(folder.results() / "summary.json"));
  json.erase("wall_s");
  return json;
}

} // namespace

TEST(ResumedProgram, KilledAtRandomLeavesTheSameFiles)
{
  const Folder whole("whole"), folder("killed");
  ASSERT_EQ(gestell("run " + press + whole.option()).exit_code, 0);
  std::mt19937                           random(22);
  std::uniform_real_distribution<double> seconds(0.1, 0.6);
  int                                    kills = 0;
  std::string                            resume;
  for (; kills < 4; ++kills)
  {
    const pid_t child = started("run " + press + folder.option() + resume);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds(random)));
    const int status = killed(child, SIGKILL);
    if (WIFEXITED(status))
      break; // it came to its end
    resume = std::filesystem::exists(folder.results() / "checkpoint.bin") ? "--resume" : "";
  }
  if (!std::filesystem::exists(folder.results() / "summary.json"))
    expect_answer(gestell("run " + press + folder.option() + resume), 0, {"report"});
  EXPECT_GT(kills, 0);
  EXPECT_EQ(read(folder.results() / "history.csv"), read(whole.results() / "history.csv"));
  EXPECT_EQ(summary(folder)["events"], summary(whole)["events"]);
  EXPECT_EQ(summary(folder)["signals"], summary(whole)["signals"]);
  EXPECT_EQ(summary(folder)["energy"], summary(whole)["energy"]);
  EXPECT_EQ(summary(folder)["work"], summary(whole)["work"]);
  EXPECT_FALSE(std::filesystem::exists(folder.results() / "checkpoint.bin"));
}

TEST(PeriodicCommand, SaysThatItReplacesARun)
{
  const Folder      folder("replaced_run");
  const std::string said = " will be replaced", press = scene("press_minimal.toml") + folder.option();
  ASSERT_EQ(gestell("run --set run.end=0.01 " + press).exit_code, 0);
  EXPECT_TRUE(gestell("periodic " + press).says(said) && !gestell("periodic " + press).says(said));
}

TEST(ResumedProgram, RefusesAnotherScene)
{
  const Folder folder("other");
  const pid_t  child = started("run " + press + folder.option());
  while (!std::filesystem::exists(folder.results() / "checkpoint.bin") && is_running(child))
    std::this_thread::sleep_for(std::chrono::milliseconds(1)); // a busy machine may start the program late
  const int status = killed(child, SIGTERM);
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 130);
  ASSERT_TRUE(std::filesystem::exists(folder.results() / "checkpoint.bin"));
  expect_answer(gestell("run " + press + " --set parameters.m3=3201" + folder.option() + "--resume"), 2,
                {"checkpoint.bin", "the scene has changed since", "without --resume"});
  expect_answer(gestell("run " + press + folder.option() + "--resume"), 0, {"report"});
}

} // namespace gestell::tests
