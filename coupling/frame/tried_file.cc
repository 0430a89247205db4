#include "coupling/frame/tried_file.h"

#include "fem/process/child.h"

#include <sys/stat.h>

#include <chrono>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// Device, inode, size and times; empty: unknown.
std::string identity_of(const std::string &file)
{
  struct stat found = {};
  if (::stat(file.c_str(), &found) != 0)
    return "";
  std::ostringstream text;
  text << found.st_dev << ' ' << found.st_ino << ' ' << found.st_size << ' ' << found.st_mtim.tv_sec << ' '
       << found.st_mtim.tv_nsec << ' ' << found.st_ctim.tv_sec << ' ' << found.st_ctim.tv_nsec;
  return text.str();
}

} // namespace

std::unique_lock<std::mutex> hdf5_alone()
{
  static std::mutex mutex;
  return std::unique_lock<std::mutex>(mutex);
}

std::string defect_in_child(const std::string &file, const std::string &phase, const fem::ReadingLimits &limits,
                            const std::function<std::string()> &defect)
{
  static std::set<std::string> survived;
  const std::string            found_as = identity_of(file), identity = found_as.empty() ? "" : phase + ": " + found_as;
  if (fem::in_one_process() || survived.count(identity) > 0)
    return "";
  fem::ChildTask task;
  task.path        = file;
  task.head        = file;
  task.phase       = phase;
  task.limits      = limits;
  task.library     = "HDF5";
  task.way_out     = "create the file again with `gestell reduce`";
  const auto begin = std::chrono::steady_clock::now();
  const auto watch = [&](const std::string &, double)
  {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    if (task.limits.seconds > 0. && waited.count() > task.limits.seconds) // waiting takes no processor time
      throw std::invalid_argument(file + ": HDF5 did not finish; " + task.way_out);
  };
  std::string found = fem::bytes_from_child(task, watch, [&](const fem::ChildProgress &) { return defect(); });
  if (found.empty() && !identity.empty())
    survived.insert(identity);
  return found;
}

} // namespace gestell::coupling
