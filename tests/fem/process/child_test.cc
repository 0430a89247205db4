// Work in a child process: what comes back, and what becomes of a child that dies, never ends or is not wanted any
// more.

#include "fem/process/child.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <sys/wait.h>

#include <csignal>
#include <new>
#include <unistd.h>

namespace gestell::fem
{

namespace files = std::filesystem;

using gestell::tests::refusal;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct Inner
{
  int                                  tag = 0;
  std::vector<std::array<double, 3>>   points;
  std::map<std::array<int, 2>, double> weights;
};

struct Outer
{
  std::string                             name;
  bool                                    is_sound = false;
  std::vector<Inner>                      inner;
  std::map<std::string, std::vector<int>> groups;
};

template <typename Archive>
void exchange(Archive &archive, Inner &value)
{
  auto &[tag, points, weights] = value;
  archive(tag, points, weights);
}

template <typename Archive>
void exchange(Archive &archive, Outer &value)
{
  auto &[name, is_sound, inner, groups] = value;
  archive(name, is_sound, inner, groups);
}

namespace
{

const ChildTask task = {"/dev/null", "scene.toml:3: frame: frame.step", "reading", {}, true};

template <typename Work>
std::string words(const Work &work, const ChildTask &of = task, const ChildProgress &progress = {})
{
  return refusal([&] { in_child<std::string>(of, progress, work); });
}

/// What a child never reaches.
std::string dead()
{
  return "alive";
}

TEST(InChild, ValuesComeBackAsTheyWere)
{
  const Outer there = in_child<Outer>(task, {},
                                      [](const ChildProgress &)
                                      {
                                        Outer made;
                                        made.name     = "a\0b" + std::string(1, '\0');
                                        made.is_sound = true;
                                        made.inner    = {{7, {{1., 2., 3.}, {4., 5., 6.}}, {{{1, 2}, 0.5}}}, {}};
                                        made.groups   = {{"feet", {3, 1, 2}}, {"none", {}}};
                                        return made;
                                      });
  EXPECT_EQ(there.name.size(), 2u);
  EXPECT_TRUE(there.is_sound);
  ASSERT_EQ(there.inner.size(), 2u);
  EXPECT_EQ(there.inner[0].tag, 7);
  EXPECT_EQ(there.inner[0].points, (std::vector<std::array<double, 3>>{{1., 2., 3.}, {4., 5., 6.}}));
  EXPECT_EQ(there.inner[0].weights, (std::map<std::array<int, 2>, double>{{{1, 2}, 0.5}}));
  EXPECT_EQ(there.groups, (std::map<std::string, std::vector<int>>{{"feet", {3, 1, 2}}, {"none", {}}}));
}

TEST(InChild, ALargeResultComesBackWhole)
{
  const auto numbers = in_child<std::vector<int>>(task, {},
                                                  [](const ChildProgress &)
                                                  {
                                                    std::vector<int> all(1 << 20);
                                                    for (std::size_t i = 0; i < all.size(); ++i)
                                                      all[i] = static_cast<int>(3 * i);
                                                    return all;
                                                  });
  ASSERT_EQ(numbers.size(), std::size_t(1) << 20);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    ASSERT_EQ(numbers[i], static_cast<int>(3 * i));
}

TEST(Archive, OfFewerBytesThanItNeedsIsRefusedWithoutTakingMemory)
{
  std::vector<double> many(10, 1.);
  const std::string   bytes = bytes_of(many);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(value_of<std::vector<double>>(bytes.substr(0, n)), std::runtime_error) << n;
  std::string lie = bytes;
  lie[6]          = '\x7f'; // a length of 10^16
  EXPECT_THROW(value_of<std::vector<double>>(lie), std::runtime_error);
}

TEST(Archive, SeesNumbersThatAreNotFiniteWhereverTheyStand)
{
  Outer value;
  value.inner.resize(3);
  value.inner[2].points = {{1., 2., 3.}};
  EXPECT_TRUE(is_finite(value));
  value.inner[2].points[0][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_finite(value));
  value.inner[2].points  = {};
  value.inner[1].weights = {{{0, 1}, std::numeric_limits<double>::infinity()}};
  EXPECT_FALSE(is_finite(value));
}

TEST(InChild, ExceptionsComeBackWithTheirTypeAndWords)
{
  const auto throws = [](const auto &exception)
  { return [exception](const ChildProgress &) -> std::string { throw exception; }; };
  EXPECT_EQ(words(throws(std::invalid_argument("frame.step: no shape"))), "frame.step: no shape");
  EXPECT_EQ(refusal<std::runtime_error>([&] { in_child<std::string>(task, {}, throws(std::runtime_error("disk"))); }),
            "disk");
  EXPECT_EQ(refusal<std::runtime_error>([&] { in_child<std::string>(task, {}, throws(std::out_of_range("index"))); }),
            "index");
  EXPECT_THAT(words(throws(std::bad_alloc())), HasSubstr("out of memory"));
}

TEST(InChild, ADeathIsAMessageWithTheFileAndTheWayOut)
{
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS})
    EXPECT_THAT(words(
                    [signal](const ChildProgress &)
                    {
                      std::cerr << "first\nfree(): invalid pointer" << std::endl;
                      raise(signal);
                      return dead();
                    }),
                AllOf(StartsWith("scene.toml:3: frame: frame.step: gmsh was ended by signal " + std::to_string(signal)),
                      HasSubstr("(reading)"), HasSubstr("\"free(): invalid pointer\""), Not(HasSubstr("first")),
                      HasSubstr("export the model again")));
  EXPECT_THAT(words(
                  [](const ChildProgress &)
                  {
                    std::exit(3);
                    return dead();
                  }),
              HasSubstr("ended the process (exit code 3)"));
}

TEST(InChild, ADeathBehindTheReadingAsksForAnotherMesh)
{
  EXPECT_THAT(words(
                  [](const ChildProgress &progress)
                  {
                    progress("meshing volumes", 0.5);
                    std::abort();
                    return dead();
                  }),
              AllOf(HasSubstr("(meshing volumes)"), HasSubstr("mesh.size")));
}

TEST(InChild, WhatNeverEndsIsEndedByTheLimitOfItsProcessorTime)
{
  ChildTask short_task      = task;
  short_task.limits.seconds = 1.;
  EXPECT_THAT(words(
                  [](const ChildProgress &)
                  {
                    for (volatile int i = 0;; i = i + 1)
                    {
                    }
                    return dead();
                  },
                  short_task),
              AllOf(HasSubstr("more than 1 s of processor time"), HasSubstr("GESTELL_READING_SECONDS=10")));
}

TEST(InChild, MemoryBeyondItsLimitIsAMessageAlsoIfALibraryHidesIt)
{
  ChildTask small    = task;
  small.limits.bytes = 1e8;
  const auto takes   = [](std::size_t bytes)
  {
    const std::vector<char> taken(bytes, 'x');
    return std::string(1, taken[bytes / 2]);
  };
  EXPECT_THAT(words([&](const ChildProgress &) { return takes(200000000); }, small),
              AllOf(HasSubstr("out of memory while reading it"), HasSubstr("0.1 GB")));
  EXPECT_THAT(words(
                  [&](const ChildProgress &) -> std::string
                  {
                    try
                    {
                      return takes(200000000);
                    }
                    catch (...)
                    {
                      throw std::invalid_argument("gmsh: error 1");
                    }
                  },
                  small),
              HasSubstr("out of memory"));
  EXPECT_EQ(in_child<std::string>(small, {},
                                  [&](const ChildProgress &progress)
                                  {
                                    progress("meshing", -1.);
                                    return takes(200000000);
                                  }),
            "x")
      << "the limit is of reading alone";
}

/// Whether a process is there, and not only its entry.
bool is_there(pid_t process)
{
  return kill(process, 0) == 0;
}

TEST(InChild, AnInterruptionEndsTheChildAndRemovesItsFiles)
{
  struct Interruption
  {
  };
  files::path folder;
  pid_t       child = 0;
  EXPECT_THROW(in_child<std::string>(
                   task,
                   [&](const std::string &phase, double)
                   {
                     const auto space = phase.find(' ');
                     if (space == std::string::npos)
                       return; // the first phase again, of a child that is late
                     child  = std::stoi(phase.substr(0, space));
                     folder = phase.substr(space + 1);
                     EXPECT_TRUE(files::exists(folder / "copy"));
                     throw Interruption();
                   },
                   [](const ChildProgress &progress)
                   {
                     const files::path own = files::temp_directory_path();
                     std::ofstream(own / "copy") << "text";
                     progress(std::to_string(getpid()) + " " + own.string(), 0.);
                     pause();
                     return dead();
                   }),
               Interruption);
  EXPECT_NE(child, getpid());
  EXPECT_FALSE(is_there(child));
  EXPECT_FALSE(files::exists(folder));
}

TEST(InChild, ProgressIsReportedAgainWhileNothingHappensSoThatItMayInterrupt)
{
  struct Interruption
  {
  };
  int n = 0;
  EXPECT_THROW(in_child<std::string>(
                   task,
                   [&](const std::string &phase, double share)
                   {
                     EXPECT_EQ(phase, "reading");
                     EXPECT_LT(share, 0.);
                     if (++n == 2)
                       throw Interruption();
                   },
                   [](const ChildProgress &)
                   {
                     pause();
                     return dead();
                   }),
               Interruption);
}

/// A process that waits for a child, which writes its number and its folder into a file.
pid_t waiting_process(const files::path &reported)
{
  const pid_t process = fork();
  if (process != 0)
    return process;
  in_child<std::string>(task, {},
                        [&](const ChildProgress &)
                        {
                          std::ofstream(reported.string() + ".new")
                              << getpid() << ' ' << files::temp_directory_path().string();
                          files::rename(reported.string() + ".new", reported);
                          pause();
                          return dead();
                        });
  _exit(0);
}

struct Waiting
{
  pid_t       process, child;
  files::path folder;
};

Waiting wait_for_child()
{
  const files::path reported = files::path(::testing::TempDir()) / ("gestell_child_" + std::to_string(getpid()));
  Waiting           waiting{waiting_process(reported), 0, {}};
  for (int i = 0; i < 60000 && !files::exists(reported); ++i)
    usleep(1000);
  std::string folder;
  std::ifstream(reported) >> waiting.child >> folder;
  waiting.folder = folder;
  files::remove(reported);
  return waiting;
}

int end_of(const Waiting &waiting, int signal)
{
  int status = 0;
  kill(waiting.process, signal);
  waitpid(waiting.process, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : -1;
}

TEST(InChild, ASignalThatEndsTheProcessEndsTheChildAndItsFilesBefore)
{
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
  {
    const Waiting waiting = wait_for_child();
    EXPECT_TRUE(files::exists(waiting.folder));
    EXPECT_EQ(end_of(waiting, signal), signal);
    EXPECT_FALSE(is_there(waiting.child));
    EXPECT_FALSE(files::exists(waiting.folder));
  }
}

TEST(InChild, DiesWithTheProcessThatMadeIt)
{
  const Waiting waiting = wait_for_child();
  EXPECT_EQ(end_of(waiting, SIGKILL), SIGKILL);
  for (int i = 0; i < 5000 && is_there(waiting.child); ++i) // it is another's child now, who has to bury it
    usleep(1000);
  std::ifstream status("/proc/" + std::to_string(waiting.child) + "/stat");
  std::string   number, name, state;
  status >> number >> name >> state;
  EXPECT_TRUE(state.empty() || state == "Z") << state;
  files::remove_all(waiting.folder); // nobody is left to do it
}

TEST(InChild, IsNoneWhereAllShallBeInOneProcess)
{
  ChildTask here = task;
  here.alone     = false;
  EXPECT_EQ(in_child<std::string>(here, {}, [](const ChildProgress &) { return std::to_string(getpid()); }),
            std::to_string(getpid()));
  EXPECT_NE(in_child<std::string>(task, {}, [](const ChildProgress &) { return std::to_string(getpid()); }),
            std::to_string(getpid()));
}

TEST(InChild, WritesNothingToStandardOutput)
{
  ::testing::internal::CaptureStdout();
  in_child<std::string>(task, {},
                        [](const ChildProgress &)
                        {
                          std::cout << "statistics" << std::endl;
                          return std::string();
                        });
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(ReadingLimits, GrowWithTheFileAndAreRaisedByTheEnvironment)
{
  const files::path file = files::path(::testing::TempDir()) / ("gestell_limits_" + std::to_string(getpid()));
  std::ofstream(file) << std::string(1000000, 'x');
  EXPECT_DOUBLE_EQ(reading_limits(file, FileContent::geometry, 1e12).seconds, 360.);
  EXPECT_DOUBLE_EQ(reading_limits(file, FileContent::geometry, 1e12).bytes, 2.4e9);
  EXPECT_DOUBLE_EQ(reading_limits(file, FileContent::geometry, 1e9).bytes, 1e9) << "there is no more";
  EXPECT_DOUBLE_EQ(reading_limits(file, FileContent::program, 1e12).bytes, 1e12);
  setenv("GESTELL_READING_SECONDS", "7200", 1);
  EXPECT_DOUBLE_EQ(reading_limits(file, FileContent::geometry, 1e12).seconds, 7200.);
  setenv("GESTELL_READING_SECONDS", "an hour", 1);
  EXPECT_THAT(refusal([&] { reading_limits(file, FileContent::geometry, 1e12); }), HasSubstr("\"an hour\""));
  unsetenv("GESTELL_READING_SECONDS");
  files::remove(file);
}

} // namespace
} // namespace gestell::fem
