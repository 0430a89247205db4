#include "tests/fuzz/watched_process.h"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <fstream>

namespace gestell::fuzz
{

void hold_memory()
{
  std::ifstream in("/proc/self/statm");
  double        data = 0., skipped;
  in >> skipped >> skipped >> skipped >> skipped >> skipped >> data;
  const auto   bytes = static_cast<rlim_t>(data * static_cast<double>(::sysconf(_SC_PAGESIZE)) + most_memory);
  const rlimit limit = {bytes, bytes}, no_core = {0, 0};
  ::setrlimit(RLIMIT_DATA, &limit);
  ::setrlimit(RLIMIT_CORE, &no_core);
}

double processor_seconds(pid_t process)
{
  clockid_t clock;
  timespec  time = {};
  if (::clock_getcpuclockid(process, &clock) == 0)
    ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void be_quiet_child()
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

} // namespace gestell::fuzz
