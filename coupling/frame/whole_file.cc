#include "coupling/frame/whole_file.h"

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <unistd.h>

namespace gestell::coupling
{

namespace fs = std::filesystem;

namespace
{

constexpr const char *unfinished = "unfinished-"; // first letters of the names beside
constexpr auto        writing    = std::chrono::hours(1);

std::string name_beside(const std::string &path)
{
  std::random_device random;
  return (fs::path(path).parent_path() / (unfinished + std::to_string(getpid()) + "-" + std::to_string(random())))
      .string();
}

} // namespace

WholeFile::WholeFile(const std::string &path) : path_(path), beside_(name_beside(path))
{
  errno = 0; // for the reason that finish() gives
  out_.open(beside_, std::ios::binary | std::ios::trunc);
}

WholeFile::~WholeFile()
{
  std::error_code none;
  if (!beside_.empty())
    fs::remove(beside_, none);
}

void WholeFile::finish()
{
  out_.close();
  std::error_code error;
  if (!out_)
    error = std::error_code(errno != 0 ? errno : EIO, std::generic_category());
  else
    fs::rename(beside_, path_, error);
  if (error)
    throw std::runtime_error(path_ + ": cannot be written (" + error.message() +
                             "); check the folder, its permissions and the space left, or name another folder");
  beside_.clear();
}

bool abandoned(const std::string &path)
{
  std::error_code error;
  const auto      touched = fs::last_write_time(path, error);
  return !error && fs::path(path).filename().string().rfind(unfinished, 0) == 0 &&
         touched < fs::file_time_type::clock::now() - writing;
}

} // namespace gestell::coupling
