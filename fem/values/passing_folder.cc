#include "fem/values/passing_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

namespace
{

/// The process tells its own apart, whichever library of it made them.
std::string begin_of_names()
{
  return (std::filesystem::temp_directory_path() / ("gestell_" + std::to_string(::getpid()) + "_")).string();
}

} // namespace

PassingFolder::PassingFolder()
{
  std::string name = begin_of_names() + "XXXXXX";
  if (!::mkdtemp(name.data()))
    throw std::runtime_error("no folder can be made for temporary files: " + name + ": " + std::strerror(errno) +
                             "; TMPDIR says where they go");
  path_ = name;
}

PassingFolder::~PassingFolder()
{
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string words_of_removal()
{
  return "rm -rf -- " + shell_word(begin_of_names()) + "??????; ";
}

std::string shell_word(const std::string &text)
{
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

} // namespace gestell::fem
