#include "apps/output/folder_lock.h"

#include "fem/values/shell_word.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

namespace gestell::apps
{
namespace fs = std::filesystem;
namespace
{

constexpr const char *lock_name = ".gestell-lock";

/// Operating-system locks belong to a process, so that the process must record its own.
class OwnLocks
{
public:
  bool add(const fs::path &folder)
  {
    const std::lock_guard<std::mutex> while_changed(mutex_);
    return releases_.emplace(folder, "").second;
  }
  void set_release(const fs::path &folder, const std::string &words)
  {
    const std::lock_guard<std::mutex> while_changed(mutex_);
    releases_[folder] = words;
  }
  std::string release()
  {
    const std::lock_guard<std::mutex> while_changed(mutex_);
    std::string                       words;
    for (const auto &entry : releases_)
      words += entry.second;
    return words;
  }
  void remove(const fs::path &folder)
  {
    const std::lock_guard<std::mutex> while_changed(mutex_);
    releases_.erase(folder);
  }

private:
  std::mutex                      mutex_;
  std::map<fs::path, std::string> releases_; ///< words for a shell, by folder
};

OwnLocks &own_locks()
{
  static OwnLocks locks;
  return locks;
}

std::string host()
{
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

struct flock whole_range(short type)
{
  struct flock lock = {};
  lock.l_type       = type;
  lock.l_whence     = SEEK_SET;
  return lock;
}

/// Contents of a lock file: process, computer and activity, one per line.
struct Holder
{
  std::string process, host, doing;
};

Holder holder_in(int file)
{
  char        text[1024] = {};
  const auto  n          = pread(file, text, sizeof text - 1, 0);
  std::string lines[3];
  std::size_t line = 0;
  for (ssize_t i = 0; i < n && line < 3; ++i)
    if (text[i] == '\n')
      ++line;
    else
      lines[line] += text[i];
  return {lines[0], lines[1], lines[2]};
}

[[noreturn]] void refuse_held(const fs::path &folder, const std::string &process, const std::string &host,
                              const std::string &doing, const std::string &way_out)
{
  throw std::invalid_argument(folder.string() + ": process " + process + (host.empty() ? "" : " on " + host) + " " +
                              doing + "; wait until it ends" + way_out);
}

constexpr const char *computes = "is computing results for this folder";

} // namespace

FolderLock::FolderLock(const fs::path &folder)
    : FolderLock(folder, Kind::alone, computes, ", or name another folder with -o DIR")
{
}

FolderLock::FolderLock(const fs::path &folder, Kind kind, const std::string &doing, const std::string &way_out)
    : reported_(folder), folder_(fs::absolute(folder).lexically_normal()), path_(folder_ / lock_name), kind_(kind),
      process_(getpid())
{
  if (!own_locks().add(folder_))
    refuse_held(reported_, std::to_string(process_), "", doing + " already", way_out);
  try
  {
    take(doing, way_out);
    own_locks().set_release(folder_, release());
  }
  catch (...)
  {
    give_up();
    throw;
  }
}

FolderLock::~FolderLock()
{
  if (getpid() != process_) // a child has its parent's objects, but not its locks
    return;
  if (file_ >= 0 && kind_ == Kind::alone)
    unlink(path_.c_str());
  give_up();
}

std::string FolderLock::release() const
{
  if (file_ < 0 || kind_ != Kind::alone)
    return "";
  std::string words = "rm -f -- " + fem::shell_word(path_.string()) + "; ";
  std::for_each(made_.rbegin(), made_.rend(),
                [&](const fs::path &folder) { words += "rmdir -- " + fem::shell_word(folder.string()) + "; "; });
  return words;
}

std::string words_of_release()
{
  return own_locks().release();
}

/// Folders go if nothing is in them: rmdir takes no others.
void FolderLock::give_up()
{
  if (file_ >= 0)
    close(file_);
  file_ = -1;
  if (kind_ == Kind::alone)
    std::for_each(made_.rbegin(), made_.rend(), [](const fs::path &folder) { rmdir(folder.c_str()); });
  own_locks().remove(folder_);
}

/// False: the folder went meanwhile.
bool FolderLock::open_file()
{
  std::vector<fs::path> missing;
  std::error_code       error;
  for (fs::path at = folder_; !fs::exists(at, error) && at.has_relative_path(); at = at.parent_path())
    missing.push_back(at);
  std::for_each(missing.rbegin(), missing.rend(),
                [&](const fs::path &folder)
                {
                  if (mkdir(folder.c_str(), 0777) == 0)
                    made_.push_back(folder);
                });
  file_ = open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0644);
  return file_ >= 0 || errno != ENOENT;
}

/// The owner of a lock removes the file before it releases the lock: the lock may then belong to a deleted file.
bool FolderLock::is_still_there() const
{
  struct stat open_one = {}, there = {};
  return fstat(file_, &open_one) == 0 && stat(path_.c_str(), &there) == 0 && open_one.st_dev == there.st_dev &&
         open_one.st_ino == there.st_ino;
}

void FolderLock::take(const std::string &doing, const std::string &way_out)
{
  const short   type       = kind_ == Kind::alone ? F_WRLCK : F_RDLCK;
  constexpr int most_tries = 1000; // while other processes create and remove the folder
  constexpr int most_waits = 200;  // [ms] to wait for the name of a new holder; on a full disk it never comes
  int           waits      = 0;
  for (int tries = 0; tries < most_tries; ++tries)
  {
    if (!open_file())
      continue;
    if (file_ < 0)
    {
      note_ = path_.string() + " cannot be created (" + std::strerror(errno) + ")";
      break;
    }
    struct flock lock = whole_range(type);
    if (fcntl(file_, F_SETLK, &lock) != 0)
    {
      const int reason = errno;
      lock             = whole_range(type);
      if (reason == EACCES || reason == EAGAIN)
      {
        const bool known = fcntl(file_, F_GETLK, &lock) == 0;
        if (known && lock.l_type != F_UNLCK)
        {
          const Holder      holder  = holder_in(file_); // of several the last one
          const std::string process = lock.l_pid > 0 ? std::to_string(lock.l_pid) : holder.process;
          const bool        named   = !process.empty() && process == holder.process;
          if (named || lock.l_type == F_RDLCK || waits++ == most_waits)
            refuse_held(reported_, process, named ? holder.host : "", holder.doing.empty() ? computes : holder.doing,
                        way_out);
          usleep(1000); // its name is not written yet
        }
        close(file_);
        file_ = -1;
        continue;
      }
      note_ = std::string("its file system does not support locks (") + std::strerror(reason) + ")";
      unlink(path_.c_str());
      close(file_);
      file_ = -1;
      break;
    }
    if (is_still_there())
    {
      const std::string words = std::to_string(getpid()) + "\n" + host() + "\n" + doing + "\n";
      if (ftruncate(file_, 0) != 0 || pwrite(file_, words.data(), words.size(), 0) != ssize_t(words.size()))
        return; // a full disk: locked, but without the process name
      return;
    }
    close(file_);
    file_ = -1;
  }
  if (note_.empty())
    note_ = "other processes keep creating and removing it";
  note_ =
      reported_.string() + ": " + note_ + "; the folder is not locked, so make sure that no other process writes there";
}

} // namespace gestell::apps
