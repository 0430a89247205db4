#include "apps/study/runs/study_lock.h"

#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

constexpr auto lock_name = ".lock";

/// Of the whole file, for shares side by side.
struct flock lock_of(const StudyShare &share)
{
  struct flock lock = {};
  lock.l_type       = share.is_whole() ? F_WRLCK : F_RDLCK;
  lock.l_whence     = SEEK_SET;
  return lock;
}

[[noreturn]] void refuse_held(const std::filesystem::path &folder, const struct flock &holder)
{
  const bool        shares  = holder.l_type == F_RDLCK;
  const std::string process = holder.l_pid > 0 ? "process " + std::to_string(holder.l_pid) : "another computer";
  throw std::invalid_argument(
      folder.string() + ": " + process + (shares ? " is making a share of a study there" : " is making a study there") +
      "; wait until it has ended" + (shares ? ", its rows are merged then" : "") + ", or give another folder with -o");
}

} // namespace

StudyLock::StudyLock(const std::filesystem::path &folder, const StudyShare &share)
{
  std::filesystem::create_directories(folder);
  file_ = open((folder / lock_name).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (file_ < 0)
    return;
  struct flock lock = lock_of(share);
  if (fcntl(file_, F_SETLK, &lock) == 0 || (errno != EACCES && errno != EAGAIN))
    return;
  lock = lock_of(share);
  fcntl(file_, F_GETLK, &lock);
  close(file_);
  refuse_held(folder, lock);
}

StudyLock::~StudyLock()
{
  if (file_ >= 0)
    close(file_);
}

} // namespace gestell::apps
