#include "fem/values/temporary_directory.h"

#include "fem/values/shell_word.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

namespace gestell::fem
{

namespace
{

[[noreturn]] void fail(const std::string &place, const std::string &reason)
{
  throw std::runtime_error("cannot create a folder for temporary files: " + place + ": " + reason +
                           "; set TMPDIR to another folder");
}

/// Start of the names of this process, the same in all of its libraries; empty if there is no temporary folder.
std::string begin_of_names(std::error_code &error)
{
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? std::string() : (folder / ("gestell_" + std::to_string(::getpid()) + "_")).string();
}

} // namespace

TemporaryDirectory::TemporaryDirectory()
{
  std::error_code error;
  std::string     name = begin_of_names(error) + "XXXXXX";
  if (error)
    fail("the folder for them", error.message());
  if (!::mkdtemp(name.data()))
    fail(name, std::strerror(errno));
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string words_of_removal()
{
  std::error_code   none;
  const std::string begin = begin_of_names(none);
  return begin.empty() ? "" : "rm -rf -- " + shell_word(begin) + "??????; ";
}

} // namespace gestell::fem
