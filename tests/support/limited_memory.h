#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <fstream>

namespace gestell::tests
{

/// While it lives the process may take no more than `spare` bytes beyond what it has; who tries gets std::bad_alloc.
class LimitedMemory
{
public:
  explicit LimitedMemory(std::size_t spare)
  {
    getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limited   = before_;
    limited.rlim_cur = pages * std::size_t(sysconf(_SC_PAGESIZE)) + spare;
#if !defined(__SANITIZE_ADDRESS__) // whose shadow of all memory has no room below a limit
    setrlimit(RLIMIT_AS, &limited);
#endif
  }
  ~LimitedMemory()
  {
    setrlimit(RLIMIT_AS, &before_);
  }

private:
  rlimit before_;
};

} // namespace gestell::tests
