#include "fem/values/available_memory.h"

#include "fem/values/message_text.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

/// The number in a file of a control group; infinite for "max" and for no file.
double number_in(const char *path)
{
  std::ifstream in(path);
  double        value = 0.;
  return in >> value ? value : INFINITY;
}

double of_system()
{
  std::ifstream    in("/proc/meminfo");
  constexpr double kib = 1024.;
  for (std::string key, rest; in >> key; std::getline(in, rest))
    if (double value = 0.; key == "MemAvailable:" && in >> value)
      return kib * value;
  return INFINITY;
}

/// File caches of the group, which the system frees when memory is needed.
double given_back()
{
  std::ifstream in("/sys/fs/cgroup/memory.stat");
  double        sum = 0., value = 0.;
  for (std::string key; in >> key >> value;)
    if (key == "inactive_file" || key == "active_file" || key == "slab_reclaimable")
      sum += value;
  return sum;
}

double of_group()
{
  const double allowed = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current");
  return std::isfinite(allowed) && std::isfinite(used) ? std::max(0., allowed - std::max(0., used - given_back()))
                                                       : INFINITY;
}

double of_process()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return INFINITY;
  const double used = number_in("/proc/self/statm") * double(sysconf(_SC_PAGESIZE));
  return std::isfinite(used) ? std::max(0., double(limit.rlim_cur) - used) : INFINITY;
}

} // namespace

double available_memory()
{
  return std::min({of_system(), of_group(), of_process()});
}

std::string memory_text(double bytes)
{
  constexpr double gib = 1024. * 1024. * 1024.;
  return bytes < 0.1 * gib ? text(std::round(bytes / gib * 1024.)) + " MiB"
                           : text(std::round(bytes / gib * 100.) / 100.) + " GiB";
}

void require_available(const std::string &what, double bytes, const std::string &advice)
{
  const double available = available_memory();
  if (bytes > available)
    throw std::invalid_argument(what + " would take " + memory_text(bytes) + " of memory; available are " +
                                memory_text(available) + ". " + advice);
}

} // namespace gestell::fem
