#include "coupling/frame/atomic_file.h"

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <random>
#include <unistd.h>
#include <vector>

namespace gestell::coupling
{

namespace fs = std::filesystem;

namespace
{

constexpr const char *unfinished = "unfinished-"; // prefix of the temporary names
/// one hour: older files are from a process that was killed
constexpr auto writing = std::chrono::hours(1);

std::string name_beside(const std::string &path)
{
  std::random_device random;
  return (fs::path(path).parent_path() / (unfinished + std::to_string(getpid()) + "-" + std::to_string(random())))
      .string();
}

/// unfinished-PROCESS-NUMBER: the name of a user's file may have the same prefix.
bool is_unfinished(const std::string &name)
{
  const std::string first  = unfinished;
  const auto        bar    = name.find('-', first.size());
  const auto        digits = [&](std::size_t begin, std::size_t end)
  { return begin < end && name.find_first_not_of("0123456789", begin) >= end; };
  return name.compare(0, first.size(), first) == 0 && bar != std::string::npos && digits(first.size(), bar) &&
         digits(bar + 1, name.size());
}

} // namespace

WriteFailure::WriteFailure(const std::string &path, const std::error_code &reason)
    : std::runtime_error(path + ": cannot be written (" + reason.message() +
                         "); check the folder, its permissions and the free space, or name another folder")
{
}

FileBeside::FileBeside(const std::string &path) : path_(path), nearby_(name_beside(path)) {}

FileBeside::~FileBeside()
{
  std::error_code none;
  if (!nearby_.empty())
    fs::remove(nearby_, none);
}

void FileBeside::finish()
{
  std::error_code error;
  fs::rename(nearby_, path_, error);
  if (error)
    throw WriteFailure(path_, error);
  nearby_.clear();
}

AtomicFile::AtomicFile(const std::string &path) : file_(path)
{
  errno = 0; // for the reason that finish() gives
  out_.open(file_.place(), std::ios::binary | std::ios::trunc);
}

void AtomicFile::finish()
{
  out_.close();
  if (!out_)
    throw WriteFailure(file_.path(), std::error_code(errno != 0 ? errno : EIO, std::generic_category()));
  file_.finish();
}

bool abandoned(const std::string &path)
{
  std::error_code error;
  const bool      plain   = fs::symlink_status(path, error).type() == fs::file_type::regular;
  const auto      touched = plain ? fs::last_write_time(path, error) : fs::file_time_type();
  return plain && !error && is_unfinished(fs::path(path).filename().string()) &&
         touched < fs::file_time_type::clock::now() - writing;
}

void remove_abandoned(const std::string &folder)
{
  std::error_code       none;
  std::vector<fs::path> old;
  for (fs::directory_iterator at(folder, none), end; !none && at != end; at.increment(none))
    if (abandoned(at->path().string()))
      old.push_back(at->path());
  for (const fs::path &path : old)
    fs::remove(path, none);
}

} // namespace gestell::coupling
