#include "fem/values/passing_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

PassingFolder::PassingFolder()
{
  std::string name = (std::filesystem::temp_directory_path() / "gestell_XXXXXX").string();
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

} // namespace gestell::fem
