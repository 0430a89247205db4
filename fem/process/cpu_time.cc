#include "fem/process/cpu_time.h"

#include <sys/resource.h>

namespace gestell::fem
{

double cpu_time()
{
  double seconds = 0.;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN})
  {
    rusage used{};
    getrusage(who, &used);
    for (const timeval &time : {used.ru_utime, used.ru_stime})
      seconds += double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  }
  return seconds;
}

} // namespace gestell::fem
