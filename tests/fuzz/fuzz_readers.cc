// gestell_fuzz_readers TARGET|all FROM TO: feeds the mutations of these numbers, tests/fuzz/mutation.h, as the release
// build reads them; gestell_fuzz_readers TARGET NUMBER: writes one to standard output.  Ends with 1 if there are
// findings.

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/watched_process.h"

#include <sys/mman.h>
#include <sys/wait.h>

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace
{

using namespace gestell::fuzz;

constexpr std::uint64_t of_one_process = 50000;
constexpr double        patience = 5., longest = 120.; // processor time and time of an execution [s]
constexpr std::size_t   words_kept = 4000;

/// What a process that executes leaves for the one that watches it.
struct Slate
{
  std::atomic<std::uint64_t> number; ///< that is executed
  char                       words[words_kept];
};

Slate &shared_slate()
{
  void *place = ::mmap(nullptr, sizeof(Slate), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED)
    throw std::runtime_error("no memory to share");
  return *new (place) Slate{};
}

/// Executes from `number` on; returns at the end or with a finding's words.
void execute(const Target &target, const std::vector<std::string> &seeds, std::uint64_t to, Slate &slate)
{
  for (; slate.number < to; ++slate.number)
    try
    {
      feed(target, mutation(seeds, unsigned(slate.number)));
    }
    catch (const std::exception &broken)
    {
      std::strncpy(slate.words, broken.what(), words_kept - 1);
      return;
    }
}

/// Waits for the process, and ends it if one execution takes too long.  @return its status
int watched(pid_t process, const Slate &slate)
{
  std::uint64_t number = slate.number;
  double        begin  = processor_seconds(process);
  auto          since  = std::chrono::steady_clock::now();
  int           status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0)
  {
    ::usleep(20000);
    if (slate.number != number)
    {
      number = slate.number;
      begin  = processor_seconds(process);
      since  = std::chrono::steady_clock::now();
    }
    else if (processor_seconds(process) > begin + patience ||
             std::chrono::steady_clock::now() > since + std::chrono::duration<double>(longest))
      ::kill(process, SIGXCPU);
  }
  return status;
}

/// @param alone  as the program reads: what kills a library kills a child of it
/// @return       how it ended; "" if all went well
std::string in_process(const Target &target, const std::vector<std::string> &seeds, std::uint64_t to, bool alone,
                       Slate &slate)
{
  slate.words[0]      = '\0';
  const pid_t process = ::fork();
  if (process < 0)
    throw std::runtime_error("no process");
  if (process == 0)
  {
    be_quiet_child();
    if (alone)
    {
      ::unsetenv("GESTELL_ONE_PROCESS");
      ::setenv("GESTELL_READING_SECONDS", "4", 1);
    }
    else
      ::setenv("GESTELL_ONE_PROCESS", "1", 1);
    hold_memory();
    execute(target, seeds, to, slate);
    ::_exit(slate.words[0] == '\0' ? 0 : 1);
  }
  const int status = watched(process, slate);
  if (WIFSIGNALED(status))
    return "died by signal " + std::to_string(WTERMSIG(status)) + " (" + ::strsignal(WTERMSIG(status)) + ")";
  if (WEXITSTATUS(status) != 0 || slate.number < to)
    return slate.words[0] != '\0' ? slate.words : "ended the process";
  return "";
}

bool fuzz(const Target &target, std::uint64_t from, std::uint64_t to)
{
  const auto begin      = std::chrono::steady_clock::now();
  const auto seeds      = seeds_of(target.name, GESTELL_SOURCE_DIR);
  Slate     &slate      = shared_slate();
  int        n_findings = 0, n_told = 0;
  for (slate.number = from; slate.number < to;)
  {
    const std::uint64_t first = slate.number, end = std::min(to, first + of_one_process);
    if (in_process(target, seeds, end, false, slate).empty())
      continue;
    std::uint64_t number = slate.number;
    std::string   how    = in_process(target, seeds, number + 1, true, slate);
    slate.number         = number;
    if (how.empty() && in_process(target, seeds, number + 1, false, slate).empty())
    {
      slate.number = first; // what one of the others broke the program leaves to a child
      how          = in_process(target, seeds, number + 1, true, slate);
      if (!how.empty())
        how += ", but not alone; from " + std::to_string(first) + " on it does, and in children";
      number = how.empty() ? number : slate.number.load();
    }
    if (!how.empty())
      std::cout << target.name << ' ' << number << ": " << how << std::endl;
    n_findings += !how.empty();
    n_told += how.empty();
    slate.number = number + 1;
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::cout << target.name << ": " << to - from << " executions, " << n_findings << " findings, " << n_told
            << " deaths of libraries told by a message, " << int(double(to - from) / took.count()) << " a second"
            << std::endl;
  return n_findings == 0;
}

int run(int argc, char **argv)
{
  if (argc < 3 || argc > 4)
  {
    std::cerr << "gestell_fuzz_readers TARGET|all FROM TO, or TARGET NUMBER; targets:";
    for (const Target &target : targets())
      std::cerr << ' ' << target.name;
    std::cerr << '\n';
    return 2;
  }
  const std::string   name = argv[1];
  const std::uint64_t from = std::stoull(argv[2]);
  if (argc == 3)
  {
    std::cout << mutation(seeds_of(target(name).name, GESTELL_SOURCE_DIR), unsigned(from));
    return 0;
  }
  if (::access("/dev/shm", W_OK) == 0)
    ::setenv("TMPDIR", "/dev/shm", 0); // files there are quick
  file_of("first", "");                // its folder is this process's, which removes it
  const std::uint64_t to = std::stoull(argv[3]);
  if (name != "all")
    target(name);
  if (from >= to || to > UINT32_MAX)
    throw std::invalid_argument("needs FROM < TO <= 4294967295");
  bool none = true;
  for (const Target &target : targets())
    if (name == "all" || name == target.name)
      none = fuzz(target, from, to) && none;
  return none ? 0 : 1;
}

} // namespace

int main(int argc, char **argv)
{
  try
  {
    return run(argc, argv);
  }
  catch (const std::exception &error)
  {
    std::cerr << "gestell_fuzz_readers: " << error.what() << '\n';
    return 2;
  }
}
