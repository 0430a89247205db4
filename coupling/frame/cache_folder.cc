#include "coupling/frame/cache_folder.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gestell::coupling
{

namespace
{

namespace fs = std::filesystem;

std::string variable(const char *name)
{
  const char *value = std::getenv(name);
  return value ? value : "";
}

/// Home folder of the user; empty if there is none, as in a container or a service.
std::string home_of_user()
{
  std::array<char, 4096> texts{};
  struct passwd          user
  {
  };
  struct passwd *found = nullptr;
  if (getpwuid_r(geteuid(), &user, texts.data(), texts.size(), &found) != 0 || !found || !found->pw_dir)
    return "";
  std::error_code   none;
  const std::string home = found->pw_dir;
  return home != "/" && fs::is_directory(home, none) ? home : "";
}

} // namespace

std::string cache_folder()
{
  if (const auto own = variable("GESTELL_CACHE"); !own.empty())
    return own;
  if (const auto xdg = variable("XDG_CACHE_HOME"); !xdg.empty())
    return (fs::path(xdg) / "gestell").string();
  const auto home = variable("HOME").empty() ? home_of_user() : variable("HOME");
  return home.empty() ? "" : (fs::path(home) / ".cache" / "gestell").string();
}

std::string foreign(const std::string &path)
{
  struct stat status
  {
  };
  if (stat(path.c_str(), &status) != 0)
    return {};
  if (status.st_uid != geteuid() && status.st_uid != 0)
    return "belongs to another user (uid " + std::to_string(status.st_uid) + ")";
  const bool own_files_only = S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0;
  if ((status.st_mode & S_IWOTH) != 0 && !own_files_only)
    return "can be written by every user";
  if ((status.st_mode & S_IWGRP) != 0 && !S_ISDIR(status.st_mode))
    return "can be written by its group";
  return {};
}

} // namespace gestell::coupling
